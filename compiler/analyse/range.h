#pragma once

#include "base/message.h"
#include "compiler/analyse/orders.h"
#include "spec/basic.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace orb::compiler {

/// A closed interval of values: from `lo` to `hi`, inclusive.
struct Range {
  std::int32_t lo = std::numeric_limits<std::int32_t>::min();
  std::int32_t hi = std::numeric_limits<std::int32_t>::max();

  static constexpr Range only(std::int32_t value) { return {value, value}; }
  constexpr bool constant() const { return lo == hi; }
  constexpr bool has(std::int32_t value) const { return lo <= value && value <= hi; }
  /// True if no value lies within `least` to `greatest`.
  constexpr bool misses(std::int64_t least, std::int64_t greatest) const {
    return hi < least || lo > greatest;
  }
  friend constexpr bool operator==(Range a, Range b) { // branch-free
    return ((a.lo ^ b.lo) | (a.hi ^ b.hi)) == 0;
  }
};

/// The smallest range that contains both.
constexpr Range join(Range a, Range b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// The possible results of the robot's 32-bit arithmetic on operands in these ranges. Operands that
/// would stop the program (a zero divisor, a shift by more than 31) do not contribute.
///
/// By reference: a copy of a range whose halves were just stored stalls the processor.
Range apply(spec::Operator op, const Range& left, const Range& right);

/// The possible results of a function for operands that it accepts.
Range apply(spec::Function function, const Range& operand);

/// True if all values have the same sign and the same quotient: then remainders keep their order.
bool has_one_quotient(Range left, std::int32_t divisor);

/// The values of the left side of a comparison for which it can hold; nothing if there are none.
std::optional<Range> where(Orders orders, Range left, Range right);

/// The result of a comparison if it is the same for all values.
std::optional<bool> answer_of(Orders orders, Range left, Range right);

/// The likely intended value for a parameter that does not take `value`: the same heading within
/// one turn, or the nearest brightness or speed; nothing if that is ambiguous.
std::optional<std::int32_t> nearest_allowed(const spec::Parameter& parameter, std::int32_t value);

/// States the allowed values: `the heading of `goroll` must be 0 to 359`.
Message allowed_values(std::string_view word, const spec::Parameter& parameter);

/// The heading that drives forward the way `heading` drives at a negative speed, which means
/// reverse. Nothing if either is too far out of range, or the speed is not negative.
std::optional<std::int32_t> heading_back(std::int64_t heading, std::int64_t speed);

/// Widens a growing range to the next of these ascending landmarks, so that it grows only a few
/// times. The landmarks include the least and the greatest number.
Range widen(std::span<const std::int32_t> landmarks, Range before, Range now);

/// The landmarks of a program with these constants: each constant and its neighbours.
std::vector<std::int32_t> landmarks_of(std::vector<std::int32_t> named);

/// Prints `5` or `1 to 9`.
Message shown(Range range);

/// The least and greatest number of characters that values of a range print as.
struct Digits {
  std::uint32_t least;
  std::uint32_t most;
};
Digits printed(Range range);

} // namespace orb::compiler
