#pragma once

#include "structured/lower/code.h"

#include <optional>
#include <span>

namespace orb::structured {

/// A test with the lines of its two paths, which only assign and print and then meet: `if c goto L;
/// passed; goto E; L: taken; E:`, or, without the second path, `if c goto L; passed; L:`. Both may
/// also end in the same jump or in a `return`.
struct Arms {
  std::uint32_t passed = none; ///< the first line of each path
  std::uint32_t passed_end = none;
  std::uint32_t taken = none;
  std::uint32_t taken_end = none; ///< where they meet: a label, a jump or a `return`
  bool has_both() const { return taken != taken_end; }
  /// True if it fits into one line of the robot.
  bool is_short() const { return passed_end - passed == 1 && taken_end - taken <= 1; }
};

/// The arms of the test at line `i`; `named` gives the references of each label.
std::optional<Arms> arms_at(const Code& code, std::span<const std::uint32_t> named,
                            std::uint32_t i);

/// True if a test and its arms fit into one line of the robot.
inline bool is_one_line(const Code& code, std::span<const std::uint32_t> named, std::uint32_t i) {
  const auto arms = arms_at(code, named, i);
  return arms && arms->is_short();
}

/// Finds a test of a value with two possible values whose arms differ in numbers, and computes
/// those numbers from the value.
bool compute_arms(Code& code);

} // namespace orb::structured
