#pragma once

#include "testing/results.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <map>
#include <string>
#include <string_view>

// Pages that a teacher hands back: one for each pupil, and certificates to print.

namespace orb::testing {

/// What is shown of one test of a pupil.
struct Shown {
  std::string picture; ///< of its first run that failed, else of its first: SVG
  std::string replay;  ///< the page that plays it back; empty where there is none
};

/// A page with all results of a program, its pictures inside: it can be handed on alone. Names of
/// replays count from the folder of the report, and the page is in another one there.
std::string pupil_page(std::string_view name, const Table::Row& row,
                       const std::map<const GroupResult*, Shown>& shown, const Speech& speech);

/// A sheet of paper for each name.
std::string certificates(const std::vector<std::string>& names, const Table& table,
                         const Speech& speech);

} // namespace orb::testing
