#pragma once

#include "base/source.h"
#include "spec/basic.h"

#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

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
  std::string message;
  std::string help;
};

/// Of a `for` that never moves on.
inline Said step_of_zero() {
  return {"the step of the loop is 0", "write `step 1`, or `step -1` to count down"};
}

/// `step 0`, with its word: from behind the `end` of a loop to the end of its `step`.
inline Span step_clause(std::string_view text, Span end, Span step) {
  return {static_cast<std::uint32_t>(text.find_first_not_of(" \t", end.end)), step.end};
}

/// Of two comparisons with one answer, and what was likely meant.
inline Said one_answer(std::string_view test, bool answer, std::string_view meant) {
  return {fmt::format("`{}` is {} true", test, answer ? "always" : "never"),
          fmt::format("write `{}`", meant)};
}

/// Of `a = b`, then `b = a`; `kept` is a name for the old value.
inline Said lost_exchange(std::string_view a, std::string_view b, std::string_view kept) {
  return {
      fmt::format("the old value of `{0}` is lost: the next line sets `{1}` to itself", a, b),
      fmt::format("save it first: `{2} = {0}`, then `{0} = {1}`, then `{1} = {2}`", a, b, kept)};
}

/// Of a share that is divided first, and the same multiplied first.
inline Said divides_first(std::string_view share, std::string_view meant) {
  return {fmt::format("`{}` discards the remainder of the division", share),
          fmt::format("multiply first: `{}`", meant)};
}

/// Of a variable that is only ever multiplied.
inline Said stays_zero(std::string_view name) {
  return {fmt::format("`{}` starts at 0, and 0 times anything is 0", name),
          fmt::format("set it above the loop: `{} = 1`", name)};
}

/// Of a sum that a line of its loop sets back.
inline Said sum_restarts(std::string_view name, std::string_view line, std::string_view loop) {
  return {fmt::format("`{}` is reset in every iteration of the loop", name),
          fmt::format("write `{}` above the {}", line, loop)};
}

} // namespace orb::compiler
