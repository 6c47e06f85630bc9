#pragma once

#include "base/message.h"
#include "spec/basic.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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
  friend constexpr bool operator==(Range a, Range b) { // without a branch
    return ((a.lo ^ b.lo) | (a.hi ^ b.hi)) == 0;
  }
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

/// What the left side of a comparison can be where it holds, or where it does not; nothing: that
/// cannot be.
enum class Holds : std::uint8_t { Yes, No };
std::optional<Range> where(spec::Relation relation, Holds holds, Range left, Range right);

/// What was most likely meant by a value that a parameter does not take: the same heading within
/// one turn, the nearest brightness or speed; nothing where that is not clear.
std::optional<std::int32_t> nearest_allowed(const spec::Parameter& parameter, std::int32_t value);

/// What the value may be: `the heading of `goroll` must be 0 to 359`.
Message allowed_values(std::string_view word, const spec::Parameter& parameter);

/// The heading to drive in instead, for a speed below 0: who writes that wants to drive back.
/// Nothing where one of them is too far out.
std::optional<std::int32_t> heading_back(std::int64_t heading, std::int64_t speed);

/// `now`, which grows: on to the next of these ascending landmarks, so that it grows a few times
/// only. They begin and end with the least and the greatest number.
Range widen(std::span<const std::int32_t> landmarks, Range before, Range now);

/// The landmarks of a program that names these numbers: each of them and its neighbours.
std::vector<std::int32_t> landmarks_of(std::vector<std::int32_t> named);

/// `5` or `1 to 9`.
Message shown(Range range);

/// How many characters the numbers of a range take when printed: the least and the most.
struct Digits {
  std::uint32_t least;
  std::uint32_t most;
};
Digits printed(Range range);

} // namespace orb::compiler
