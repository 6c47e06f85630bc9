#pragma once

#include "compiler/analyse/range.h"
#include "compiler/text/program.h"

#include <cstdint>
#include <span>

namespace orb::compiler {

/// Where a value comes from. A result has the last of those of its operands.
enum class Origin : std::uint8_t {
  Program, ///< numbers and chance
  World,   ///< a person or a sensor: anything at any time
  Motion,  ///< what the program itself causes: a time, a place, a speed
};

/// What a test of a variable tells of the others.
enum class Ties : std::uint8_t {
  None,    ///< nothing
  Depends, ///< something: it was computed from them
  Shared,  ///< the same, or they were computed from it, or changed on the same path
};

/// The analysis state of a value.
struct Value {
  Range range;
  bool exact = false; ///< both ends of the range are values that occur
  bool dense = false; ///< in addition, so are all values between, as for a sensor
  Origin origin = Origin::Program;
  bool narrowed = false; ///< narrowed by a test, so perhaps to values that never occur
  bool bounded = false;  ///< the test, or one as strict, is on every path
  bool fresh = false;    ///< of numbers and chance in this expression, so independent of the rest
  Ties ties = Ties::None;

  static constexpr Value only(std::int32_t number) { return {Range::only(number), true, true}; }
  friend constexpr bool operator==(const Value&, const Value&) = default;
};

/// The value at a line that two paths reach. Its ends occur if those of both do, or if one of them
/// has the whole range.
Value join(const Value& left, const Value& right);

/// The result of `left op right`. Its ends occur if those of the operands do and one of them is a
/// number or fresh: two that vary may depend on each other.
Value result_of(spec::Operator op, const Value& left, const Value& right);

/// The result of a function.
Value result_of(spec::Function function, const Value& operand);

/// The value of a node that is no letter, element or sensor. `known` has the values of the nodes
/// before it, from node `first` on.
Value value_of(const Program& program, std::uint32_t node, std::span<const Value> known,
               std::uint32_t first = 0);

} // namespace orb::compiler
