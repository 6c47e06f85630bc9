#pragma once

#include "bytecode/arithmetic.h"
#include "bytecode/op.h"
#include "spec/limits.h"
#include "vm/machine_core.h"

#include <bit>

namespace orb::vm {

// What the blocks of machine_loop.h are made of; each is inlined and decided at compile time.

using bytecode::Arithmetic;
using bytecode::element_by_index;
using bytecode::element_count;
using bytecode::first_element;
using bytecode::Glue;
using bytecode::index_variable;
using bytecode::Op;
using spec::BasicError;
using spec::Relation;

/// Stands for "no error": the robot's errors count from 1.
inline constexpr BasicError no_error{};

constexpr bool failed(BasicError error) {
  return error != no_error;
}

__extension__ typedef __int128 Wide;

/// x / d, rounded toward zero, for d > 1 and reciprocal = 2^63 / d + 1: the error of the product is
/// less than 1 / d, so only the rounding of negative quotients remains to be mended.
constexpr std::int32_t divide_by(std::int32_t x, std::int64_t reciprocal) {
  return static_cast<std::int32_t>(Wide{x} * reciprocal >> 63) + (x < 0 ? 1 : 0);
}

template <Arithmetic op>
inline BasicError calculate(std::int32_t x, std::int32_t y, const std::int64_t* reciprocal,
                            std::int32_t& out) {
  if constexpr (op == Arithmetic::Multiply) {
    out = bytecode::multiply(x, y);
  } else if constexpr (op == Arithmetic::Divide || op == Arithmetic::Remainder) {
    if (y == 0)
      return BasicError::DivideByZero;
    if (y == -1) // the one quotient that does not fit
      out = op == Arithmetic::Divide ? bytecode::subtract(0, x) : 0;
    else
      out = op == Arithmetic::Divide ? x / y : x % y;
  } else if constexpr (op == Arithmetic::ShiftLeft || op == Arithmetic::ShiftRight) {
    if (static_cast<std::uint32_t>(y) >
        static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestShift)))
      return BasicError::BadNumericParameter;
    out = op == Arithmetic::ShiftLeft ? bytecode::shift_left(x, y) : bytecode::shift_right(x, y);
  } else if constexpr (op == Arithmetic::Add) {
    out = bytecode::add(x, y);
  } else if constexpr (op == Arithmetic::Subtract) {
    out = bytecode::subtract(x, y);
  } else if constexpr (op == Arithmetic::And) {
    out = x & y;
  } else if constexpr (op == Arithmetic::Or) {
    out = x | y;
  } else if constexpr (op == Arithmetic::DivideBy) {
    out = divide_by(x, *reciprocal);
  } else if constexpr (op == Arithmetic::DivideByPower) {
    const std::int32_t upward = x >> 31 & (y - 1); // negative numbers round toward zero
    out = (x + upward) >> std::countr_zero(static_cast<std::uint32_t>(y));
  } else if constexpr (op == Arithmetic::RemainderByPower) {
    const std::int32_t upward = x >> 31 & (y - 1);
    out = ((x + upward) & (y - 1)) - upward;
  } else if constexpr (op == Arithmetic::RemainderBy) {
    out = bytecode::subtract(x, bytecode::multiply(divide_by(x, *reciprocal), y));
  }
  return no_error;
}

template <Relation relation>
constexpr bool holds(std::int32_t x, std::int32_t y) {
  if constexpr (relation == Relation::Equal)
    return x == y;
  else if constexpr (relation == Relation::NotEqual)
    return x != y;
  else if constexpr (relation == Relation::Less)
    return x < y;
  else
    return x > y;
}

template <Glue glue>
constexpr bool glued(bool first, bool second) {
  if constexpr (glue == Glue::And)
    return static_cast<bool>(first & second);
  else
    return static_cast<bool>(first | second);
}

} // namespace orb::vm
