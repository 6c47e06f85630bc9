#pragma once

#include "spec/basic.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace orb::compiler {

/// The values that an expression can have: all from `lo` to `hi`, both included.
struct Range {
  std::int32_t lo = std::numeric_limits<std::int32_t>::min();
  std::int32_t hi = std::numeric_limits<std::int32_t>::max();

  static constexpr Range only(std::int32_t value) { return {value, value}; }
  constexpr bool constant() const { return lo == hi; }
  constexpr bool has(std::int32_t value) const { return lo <= value && value <= hi; }
  /// Whether no value lies within `least` to `greatest`.
  constexpr bool misses(std::int64_t least, std::int64_t greatest) const {
    return hi < least || lo > greatest;
  }
  friend constexpr bool operator==(Range, Range) = default;
};

/// The least range that holds both.
constexpr Range join(Range a, Range b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// What the robot's 32-bit arithmetic can make of operands in these ranges. Where it would stop the
/// program (a zero divisor, a shift by more than 31) the result is what the other values give.
///
/// By reference: a copy of a range whose halves have just been stored stalls the processor.
Range apply(spec::Operator op, const Range& left, const Range& right);

/// What a function can give for operands that it accepts.
Range apply(spec::Function function, const Range& operand);

/// `0 - operand`.
Range negate(const Range& operand);

/// How many characters the numbers of a range take when printed: the least and the most.
struct Digits {
  std::uint32_t least;
  std::uint32_t most;
};
Digits printed(Range range);

} // namespace orb::compiler
