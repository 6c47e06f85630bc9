#pragma once

#include "structured/lower/code.h"

#include <optional>
#include <span>

namespace orb::structured {

/// A test with the lines of its two ways, which only set and show and then meet:
/// `if c goto L; passed; goto E; L: taken; E:`, or without the second way
/// `if c goto L; passed; L:`. Both may also end in the same jump or in a `return`.
struct Arms {
  std::uint32_t passed = none; ///< the first line of each way
  std::uint32_t passed_end = none;
  std::uint32_t taken = none;
  std::uint32_t taken_end = none; ///< where they meet: a label, a jump or a `return`
  bool has_both() const { return taken != taken_end; }
  /// Whether the robot has one line for all of it.
  bool is_short() const { return passed_end - passed == 1 && taken_end - taken <= 1; }
};

/// Those of the test at line `i`; `named` is of each label: how often.
std::optional<Arms> arms_at(const Code& code, std::span<const std::uint32_t> named,
                            std::uint32_t i);

/// Whether the robot has one line for a test and its arms.
inline bool is_one_line(const Code& code, std::span<const std::uint32_t> named, std::uint32_t i) {
  const auto arms = arms_at(code, named, i);
  return arms && arms->is_short();
}

/// A test of a value that is one of two, and lines that differ in numbers: these are computed from
/// that value instead.
bool compute_arms(Code& code);

} // namespace orb::structured
