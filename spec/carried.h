#pragma once

namespace orb::spec {

/// A row of a table of commands as linked into a program. ORB_BRIEF_RULES drops what only the
/// reference shows, to keep the download of a web page small.
template <typename Row>
constexpr Row carried(Row row) {
#ifdef ORB_BRIEF_RULES
  row.source = row.example = row.summary = {};
#endif
  return row;
}

} // namespace orb::spec
