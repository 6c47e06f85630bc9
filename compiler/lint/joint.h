#pragma once

#include "spec/basic.h"

#include <array>
#include <cstdint>
#include <optional>

namespace orb::compiler {

/// `value relation number`.
struct Bound {
  spec::Relation relation;
  std::int64_t number;

  bool holds(std::int64_t value) const {
    switch (relation) {
    case spec::Relation::Equal: return value == number;
    case spec::Relation::NotEqual: return value != number;
    case spec::Relation::Less: return value < number;
    case spec::Relation::Greater: return value > number;
    }
    return false;
  }
};

/// What two comparisons of one value answer together where that is always the same: `A > 9 and A <
/// 1` never holds, `A ! 1 or A ! 2` always. Nothing where it depends on the value. Whether one of
/// them changes its answer is seen next to its number.
inline std::optional<bool> joint_answer(const Bound& first, const Bound& second, bool both) {
  std::optional<bool> answer;
  for (const auto number : {first.number, second.number})
    for (const auto value : {number - 1, number, number + 1}) {
      const bool holds = both ? first.holds(value) && second.holds(value)
                              : first.holds(value) || second.holds(value);
      if (answer && *answer != holds)
        return std::nullopt;
      answer = holds;
    }
  return answer;
}

} // namespace orb::compiler
