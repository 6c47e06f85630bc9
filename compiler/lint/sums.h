#pragma once

#include "base/source.h"
#include "compiler/text/texts.h"
#include "spec/basic.h"

#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>

// What is computed and lost on the way, for numbered and for structured programs: what two
// comparisons answer together, and the words for what is found.

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

/// A finding in words.
struct Said {
  Message message;
  Message help;
};

/// Of a `for` that never moves on.
inline Said step_of_zero() {
  return {texts::StepIsZero(), texts::WriteOrCountDown("step 1", "step -1")};
}

/// `step 0`, with its word: from behind the `end` of a loop to the end of its `step`.
inline Span step_clause(std::string_view text, Span end, Span step) {
  return {static_cast<std::uint32_t>(text.find_first_not_of(" \t", end.end)), step.end};
}

/// Of two comparisons with one answer, and what was likely meant.
inline Said one_answer(std::string_view test, bool answer, std::string_view meant) {
  return {answer ? texts::AlwaysTrue(test) : texts::NeverTrue(test), texts::Write(meant)};
}

/// Of `a = b`, then `b = a`; `kept` is a name for the old value.
inline Said lost_exchange(std::string_view a, std::string_view b, std::string_view kept) {
  return {texts::OldValueLost(a, b),
          texts::SaveItFirst(fmt::format("{} = {}", kept, a), fmt::format("{} = {}", a, b),
                             fmt::format("{} = {}", b, kept))};
}

/// Of a share that is divided first, and the same multiplied first.
inline Said divides_first(std::string_view share, std::string_view meant) {
  return {texts::DiscardsRemainder(share), texts::MultiplyFirst(meant)};
}

/// Of a variable that is only ever multiplied.
inline Said stays_zero(std::string_view name) {
  return {texts::StartsAtZero(name), texts::SetAboveLoop(fmt::format("{} = 1", name))};
}

/// Of a sum that a line of its loop sets back, and where that belongs.
inline Said sum_restarts(std::string_view name, Message where) {
  return {texts::ResetInEveryIteration(name), std::move(where)};
}

} // namespace orb::compiler
