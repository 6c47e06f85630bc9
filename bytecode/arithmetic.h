#pragma once

#include "spec/basic.h"
#include "spec/limits.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace orb::bytecode {

// Integer arithmetic of the robot: 32 bits, two's complement, wrapping. The machine
// and the compiler's constant folding use it; the evaluator of the tests implements the same rules
// independently.

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
/// Rounds toward zero; `y` must not be 0. INT32_MIN / -1 wraps to INT32_MIN.
constexpr std::int32_t divide(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} / y);
}
/// The result has the sign of `x`; `y` must not be 0.
constexpr std::int32_t remainder(std::int32_t x, std::int32_t y) {
  return wrap(std::int64_t{x} % y);
}
constexpr bool is_shift_count(std::int32_t count) {
  return count >= 0 && count <= spec::value_of(spec::Limit::GreatestShift);
}
/// `count` must be 0 to 31.
constexpr std::int32_t shift_left(std::int32_t x, std::int32_t count) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(x) << count);
}
/// Arithmetic shift; `count` must be 0 to 31.
constexpr std::int32_t shift_right(std::int32_t x, std::int32_t count) {
  return x >> count;
}
constexpr std::int32_t absolute(std::int32_t x) {
  return x < 0 ? subtract(0, x) : x;
}

/// Applies an operator; returns nothing if it would stop the program.
constexpr std::optional<std::int32_t> calculate(spec::Operator op, std::int32_t x, std::int32_t y) {
  using Value = std::optional<std::int32_t>;
  switch (op) {
  case spec::Operator::Multiply: return multiply(x, y);
  case spec::Operator::Divide: return y == 0 ? Value() : divide(x, y);
  case spec::Operator::Remainder: return y == 0 ? Value() : remainder(x, y);
  case spec::Operator::ShiftLeft: return is_shift_count(y) ? shift_left(x, y) : Value();
  case spec::Operator::ShiftRight: return is_shift_count(y) ? shift_right(x, y) : Value();
  case spec::Operator::Add: return add(x, y);
  case spec::Operator::Subtract: return subtract(x, y);
  case spec::Operator::And: return x & y;
  case spec::Operator::Or: return x | y;
  }
  return std::nullopt;
}

/// Adjusts a negative `x` so that a right shift divides it by a power of two and rounds toward
/// zero.
constexpr std::int32_t before_cut(std::int32_t x, std::int32_t power) {
  return add(x, x >> 31 & (power - 1));
}

/// The upper 64 bits of a 96-bit product, from two partial products; `y` must be positive.
constexpr std::int64_t upper_by_parts(std::int32_t x, std::int64_t y) {
  const auto low = x * (y & 0xFFFFFFFF); // by the low half of `y`
  const auto high = x * (y >> 32);
  return (high + (low >> 32)) >> 32;
}
#ifdef __wasm__ // no 128-bit product
constexpr std::int64_t upper(std::int32_t x, std::int64_t y) {
  return upper_by_parts(x, y);
}
#else
__extension__ typedef __int128 Wide;
constexpr std::int64_t upper(std::int32_t x, std::int64_t y) {
  return static_cast<std::int64_t>(Wide{x} * y >> 64);
}
#endif

/// The factor for divide_by(). The divisor must be above 2 and not a power of two.
constexpr std::int64_t reciprocal(std::int32_t divisor) {
  return static_cast<std::int64_t>(~std::uint64_t{0} / static_cast<std::uint64_t>(divisor)) + 1;
}
/// divide() by the divisor of `reciprocal`. The error of the product is below 1 / divisor, so only
/// negative quotients, which it rounds down, need a correction of 1.
constexpr std::int32_t divide_by(std::int32_t x, std::int64_t reciprocal) {
  return static_cast<std::int32_t>(upper(x, reciprocal)) - (x >> 31);
}
static_assert([] {
  for (const std::int32_t x : {0, 1, -1, 7, -7, 1'000'003, 2'147'483'647, -2'147'483'647 - 1})
    for (const std::int32_t divisor : {3, 7, 1000, 65'537, 2'147'483'647})
      if (upper_by_parts(x, reciprocal(divisor)) != upper(x, reciprocal(divisor)) ||
          divide_by(x, reciprocal(divisor)) != x / divisor)
        return false;
  return true;
}());
/// remainder() by the same divisor.
constexpr std::int32_t remainder_by(std::int32_t x, std::int32_t divisor, std::int64_t reciprocal) {
  return subtract(x, multiply(divide_by(x, reciprocal), divisor));
}

} // namespace orb::bytecode
