#pragma once

#include "base/source.h"
#include "compiler/analyse/reading.h"
#include "compiler/text/texts.h"
#include "spec/basic.h"

#include <cstdint>
#include <optional>
#include <string_view>

// What the checks of numbered and of structured programs share: joint results of two comparisons,
// and messages.

namespace orb::compiler {

/// The joint result of two comparisons of one value if it is constant: `A > 9 and A < 1` never
/// holds, `A ! 1 or A ! 2` always does. Nothing if it depends on the value. A comparison changes
/// its result only next to its number, so those values are tested.
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

/// The message and help of a finding.
struct FindingTexts {
  Message message;
  Message help;
};

/// For a `for` that never advances.
inline FindingTexts step_of_zero() {
  return {texts::StepIsZero(), texts::WriteOrCountDown("step 1", "step -1")};
}

/// The span of `step 0` with its word: from the end of a loop's `end` to the end of its `step`.
inline Span step_clause(std::string_view text, Span end, Span step) {
  return {static_cast<std::uint32_t>(text.find_first_not_of(" \t", end.end)), step.end};
}

/// For two comparisons with a constant result, and the likely intent.
inline FindingTexts one_answer(std::string_view test, bool answer, std::string_view meant) {
  return {answer ? texts::AlwaysTrue(test) : texts::NeverTrue(test), texts::Write(meant)};
}

} // namespace orb::compiler
