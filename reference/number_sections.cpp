// What the robot has that is one number each.

#include "reference/sections.h"
#include "spec/ball.h"
#include "spec/limits.h"
#include "spec/macro.h"

#include <fmt/format.h>

namespace orb::reference {
namespace {

/// A row of any of the tables, which have the same columns.
template <typename Row>
Entry entry_of(const Row& row) {
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
    section.entries.push_back(entry_of(row));
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
