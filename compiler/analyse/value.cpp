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

/// A constant occurs, whatever it comes from.
Value settled(Value value) {
  if (!value.range.constant())
    return value;
  return {value.range, true, true, Origin::Program, value.narrowed};
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
  const bool exact =
      left.exact && right.exact && (from_number || by_number || left.fresh || right.fresh);
  const bool dense = exact && left.dense && right.dense;
  switch (op) {
  case spec::Operator::Add:
  case spec::Operator::Subtract:
    result.exact = exact;
    result.dense = dense;
    break;
  case spec::Operator::Multiply: result.exact = exact; break;
  case spec::Operator::Divide:
    result.exact = exact && by_number;
    result.dense = dense && by_number;
    break;
  case spec::Operator::Remainder:
    result.exact = result.dense =
        dense && by_number && fills_remainders(left.range, right.range.lo);
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
  case NodeKind::Binary:
    return result_of(static_cast<spec::Operator>(one.what),
                     known[program.nodes[node - 1].first - first - 1], known[last]);
  case NodeKind::Letter:
  case NodeKind::Indexed:
  case NodeKind::System: break;
  }
  return {};
}

} // namespace orb::compiler
