#pragma once

#include "spec/basic.h"
#include "spec/limits.h"

#include <cstdint>
#include <limits>
#include <optional>

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

/// What an operator makes of two numbers; nothing where it would stop the program.
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

/// Moves a negative `x` so far that cutting off its low bits divides it by a power of two and
/// rounds toward zero.
constexpr std::int32_t before_cut(std::int32_t x, std::int32_t power) {
  return add(x, x >> 31 & (power - 1));
}

/// The upper 64 bits of a product of 96, in two products; `y` is positive.
constexpr std::int64_t upper_by_parts(std::int32_t x, std::int64_t y) {
  const auto low = x * (y & 0xFFFFFFFF); // of y
  const auto high = x * (y >> 32);
  return (high + (low >> 32)) >> 32;
}
#ifdef __wasm__ // it has no wide product
constexpr std::int64_t upper(std::int32_t x, std::int64_t y) {
  return upper_by_parts(x, y);
}
#else
__extension__ typedef __int128 Wide;
constexpr std::int64_t upper(std::int32_t x, std::int64_t y) {
  return static_cast<std::int64_t>(Wide{x} * y >> 64);
}
#endif

/// What divide_by() multiplies with for a divisor that is above 2 and no power of two.
constexpr std::int64_t reciprocal(std::int32_t divisor) {
  return static_cast<std::int64_t>(~std::uint64_t{0} / static_cast<std::uint64_t>(divisor)) + 1;
}
/// divide() by the divisor of `reciprocal`: the error of the product is less than 1 / divisor, so
/// only negative quotients, which it rounds down, need one more.
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
