#pragma once

namespace orb::spec {

/// A row of the tables of commands as a program carries it. Where ORB_BRIEF_RULES is defined it is
/// without what only the reference shows, for a program that every visitor of a page loads.
template <typename Row>
constexpr Row carried(Row row) {
#ifdef ORB_BRIEF_RULES
  row.source = row.example = row.summary = {};
#endif
  return row;
}

} // namespace orb::spec
