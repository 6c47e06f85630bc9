#pragma once

#include "testing/results.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <map>
#include <string>
#include <string_view>

// Pages for a teacher to hand back: one for each pupil, and printable certificates.

namespace orb::testing {

/// What is shown of one of a pupil's tests.
struct Shown {
  std::string picture; ///< SVG of its first failed run, or else of its first run
  std::string replay;  ///< page that plays it back; empty if there is none
};

/// A self-contained page with all results of a program, including pictures. Replays are relative to
/// the folder of the report; the page is in a subfolder.
std::string pupil_page(std::string_view name, const Table::Row& row,
                       const std::map<const GroupResult*, Shown>& shown, const Speech& speech);

/// A printable sheet for each name.
std::string certificates(const std::vector<std::string>& names, const Table& table,
                         const Speech& speech);

} // namespace orb::testing
