#pragma once

#include "spec/limits.h"

#include <cstdint>
#include <limits>

namespace orb::bytecode {

// What numbers do: 32 bits, two's complement, wrapping. The machine, the compiler's
// constant folding and the evaluator of the tests agree on this file's meaning, each its own way.

constexpr std::int32_t wrap(std::int64_t value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

constexpr std::int32_t add(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} + y);
}
constexpr std::int32_t subtract(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} - y);
}
constexpr std::int32_t multiply(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} * y);
}
/// Rounds toward zero; `y` is not 0. The least number divided by -1 is itself.
constexpr std::int32_t divide(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} / y);
}
/// Has the sign of `x`; `y` is not 0.
constexpr std::int32_t remainder(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} % y);
}
constexpr bool is_shift_count(std::int32_t count) {
  return count >= 0 && count <= spec::value_of(spec::Limit::GreatestShift);
}
/// `count` is 0 to 31.
constexpr std::int32_t shift_left(std::int32_t x, std::int32_t count) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(x) << count);
}
/// Keeps the sign; `count` is 0 to 31.
constexpr std::int32_t shift_right(std::int32_t x, std::int32_t count) {
  return x >> count;
}
constexpr std::int32_t absolute(std::int32_t x) {
  return x < 0 ? subtract(0, x) : x;
}

/// Moves a negative `x` so far that cutting off its low bits divides it by a power of two and
/// rounds toward zero.
constexpr std::int32_t before_cut(std::int32_t x, std::int32_t power) {
  return add(x, x >> 31 & (power - 1));
}

__extension__ typedef __int128 Wide;

/// What divide_by() multiplies with for a divisor that is above 2 and no power of two.
constexpr std::int64_t reciprocal(std::int32_t divisor) {
  return static_cast<std::int64_t>(~std::uint64_t{0} / static_cast<std::uint64_t>(divisor)) + 1;
}
/// divide() by the divisor of `reciprocal`: the error of the product is less than 1 / divisor, so
/// only negative quotients, which it rounds down, need one more.
constexpr std::int32_t divide_by(std::int32_t x, std::int64_t reciprocal) {
  return static_cast<std::int32_t>(Wide{x} * reciprocal >> 64) - (x >> 31);
}
/// remainder() by the same divisor.
constexpr std::int32_t remainder_by(std::int32_t x, std::int32_t divisor, std::int64_t reciprocal) {
  return subtract(x, multiply(divide_by(x, reciprocal), divisor));
}

} // namespace orb::bytecode
