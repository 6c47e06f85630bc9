// Features of the robot that are identified by a number.

#include "reference/sections.h"
#include "spec/ball.h"
#include "spec/limits.h"
#include "spec/macro.h"

#include <fmt/format.h>

namespace orb::reference {
namespace {

/// Works for any of the tables, which share their columns.
template <typename Row>
Entry number_entry(const Row& row) {
  Entry entry;
  entry.name = row.name;
  entry.summary = row.summary;
  entry.facts.emplace_back("value",
                           fmt::format("{}{}{}", row.value, row.unit.empty() ? "" : " ", row.unit));
  entry.facts.emplace_back("source", row.source);
  return entry;
}

template <typename Rows>
Section with_rows(Section section, const Rows& rows) {
  for (const auto& row : rows)
    section.entries.push_back(number_entry(row));
  return section;
}

} // namespace

Section limits_section() {
  return with_rows({"limits", "Limits", "limit", {}}, spec::limits);
}

Section macro_limits_section() {
  return with_rows({"macro-limits", "Macro ids and sizes", "macro limit", {}}, spec::macro_numbers);
}

Section ball_section() {
  return with_rows({"ball", "The ball in numbers", "number of the ball", {}}, spec::ball_numbers);
}

} // namespace orb::reference
