#include "compiler/analyse/value.h"

#include <algorithm>
#include <cstdlib>

namespace orb::compiler {
namespace {

/// True if the remainders of all values of a dense range fill the range of the result.
bool fills_remainders(const Range& left, std::int32_t divisor) {
  const auto most = std::abs(std::int64_t{divisor}) - 1;
  return std::int64_t{left.hi} - left.lo >= most && (left.lo >= 0 || left.lo <= -most) &&
         (left.hi <= 0 || left.hi >= most);
}

/// True if a number divided by a value gives both ends of the range of the results.
bool takes_ends(const Value& divisor) {
  const auto& range = divisor.range;
  return range.has(0) ? divisor.dense && range.lo < 0 && range.hi > 0 : divisor.exact;
}

/// A constant occurs, whatever it comes from.
Value settled(Value value) {
  if (!value.range.constant())
    return value;
  return {value.range, true, true, Origin::Program, value.narrowed};
}

/// True if two nodes read the same variable.
bool is_same(const Node& left, const Node& right) {
  return left.kind == right.kind && left.what == right.what &&
         (left.kind == NodeKind::Letter || left.kind == NodeKind::System);
}

/// The product of a value with itself, which is never below 0 unless it overflows.
Value square_of(const Value& value) {
  auto result = result_of(spec::Operator::Multiply, value, value);
  if (result.range == Range{})
    return result;
  const bool falls_and_rises = value.range.lo < 0 && value.range.hi > 0;
  if (falls_and_rises)
    result.range.lo = 0;
  result.exact = falls_and_rises ? value.dense : value.exact;
  return result;
}

} // namespace

Value join(const Value& left, const Value& right) {
  const auto range = join(left.range, right.range);
  const bool whole_left = left.range == range;
  const bool whole_right = right.range == range;
  const bool exact =
      (left.exact && right.exact) || (left.exact && whole_left) || (right.exact && whole_right);
  const bool meet = left.range.lo <= std::int64_t{right.range.hi} + 1 &&
                    right.range.lo <= std::int64_t{left.range.hi} + 1; // no gap between them
  const bool dense = exact && ((left.dense && whole_left) || (right.dense && whole_right) ||
                               (left.dense && right.dense && meet));
  return {range,
          exact,
          dense,
          std::max(left.origin, right.origin),
          left.narrowed || right.narrowed,
          left.bounded && right.bounded,
          false,
          std::max(left.ties, right.ties)};
}

Value result_of(spec::Operator op, const Value& left, const Value& right) {
  Value result{apply(op, left.range, right.range)};
  result.narrowed = left.narrowed || right.narrowed;
  result.origin = std::max(left.origin, right.origin);
  result.ties = std::max(left.ties, right.ties);
  const bool by_number = right.range.constant();
  const bool from_number = left.range.constant();
  result.fresh = (left.fresh || from_number) && (right.fresh || by_number);
  const auto chance = [](const Value& one) { return one.fresh && one.origin == Origin::Program; };
  const bool apart = from_number || by_number || chance(left) || chance(right) || result.fresh;
  const bool exact = left.exact && right.exact && apart;
  const bool dense = exact && left.dense && right.dense;
  switch (op) {
  case spec::Operator::Add:
  case spec::Operator::Subtract:
    result.exact = exact;
    result.dense = dense;
    break;
  case spec::Operator::Multiply: result.exact = exact; break;
  case spec::Operator::Divide:
    result.exact = exact && (by_number || (from_number && takes_ends(right)));
    result.dense = dense && by_number;
    break;
  case spec::Operator::Remainder:
    if (!by_number)
      break;
    if (has_one_quotient(left.range, right.range.lo)) {
      result.exact = left.exact;
      result.dense = left.dense;
    } else if (left.dense) {
      result.dense = fills_remainders(left.range, right.range.lo);
      result.exact = result.dense || left.range.lo >= 0; // from the last one to 0
    }
    break;
  case spec::Operator::ShiftLeft:
  case spec::Operator::ShiftRight:
  case spec::Operator::And:
  case spec::Operator::Or: break;
  }
  return settled(result);
}

Value result_of(spec::Function function, const Value& operand) {
  auto result = operand;
  result.range = apply(function, operand.range);
  result.bounded = false;
  if (function == spec::Function::Rnd) {
    result.dense = operand.exact;
    result.fresh = operand.range.constant();
  } else if (function == spec::Function::Sqrt && operand.origin == Origin::Motion) {
    result.dense = operand.exact; // a distance
  } else if (function == spec::Function::Abs && operand.range.lo < 0 && operand.range.hi > 0)
    result.exact = operand.dense; // otherwise 0 need not occur
  return settled(result);
}

Value value_of(const Program& program, std::uint32_t node, std::span<const Value> known,
               std::uint32_t first) {
  const auto& one = program.nodes[node];
  const auto last = node - first - 1; // the right operand, or the only one
  switch (one.kind) {
  case NodeKind::Number: return one.overflow ? Value{} : Value::only(one.value);
  case NodeKind::Group: return known[last];
  case NodeKind::Negate: return result_of(spec::Operator::Subtract, Value::only(0), known[last]);
  case NodeKind::Call: return result_of(spec::functions[one.what].function, known[last]);
  case NodeKind::Binary: {
    const auto op = static_cast<spec::Operator>(one.what);
    const auto left = program.nodes[node - 1].first - 1; // the root of the left operand
    if (op == spec::Operator::Multiply && is_same(program.nodes[left], program.nodes[node - 1]))
      return square_of(known[last]);
    return result_of(op, known[left - first], known[last]);
  }
  case NodeKind::Letter:
  case NodeKind::Indexed:
  case NodeKind::System: break;
  }
  return {};
}

} // namespace orb::compiler
