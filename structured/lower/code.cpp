#include "structured/lower/code.h"

#include "bytecode/arithmetic.h"
#include "spec/limits.h"

#include <algorithm>
#include <limits>

namespace orb::structured {
namespace {

using spec::Operator;

bool is_low(const Term& term) {
  if (term.kind == TermKind::Number)
    return term.value < 0; // printed as a difference
  return term.kind == TermKind::Binary && spec::operators[term.what].level == spec::Level::Low;
}

std::uint8_t saturated(int levels) {
  return static_cast<std::uint8_t>(std::min(levels, 250));
}

/// True if a shift or division may stop the program.
bool may_fault(Operator op, const Term& right) {
  const bool divides = op == Operator::Divide || op == Operator::Remainder;
  const bool shifts = op == Operator::ShiftLeft || op == Operator::ShiftRight;
  if (!divides && !shifts)
    return false;
  if (right.kind != TermKind::Number)
    return true;
  return divides ? right.value == 0 : !bytecode::is_shift_count(right.value);
}

bool may_fault(spec::Function function, const Term& operand) {
  const bool certain =
      operand.kind == TermKind::Number && operand.value >= spec::info(function).least;
  return function != spec::Function::Abs && !certain;
}

} // namespace

std::uint32_t Code::number(std::int32_t value) {
  Term term;
  term.value = value;
  return add(term);
}

std::uint32_t Code::read(std::uint32_t variable) {
  Term term;
  term.kind = TermKind::Variable;
  term.left = variable;
  return add(term);
}

std::uint32_t Code::system(spec::Variable variable) {
  Term term;
  term.kind = TermKind::System;
  term.what = static_cast<std::uint8_t>(variable);
  term.effects =
      spec::info(variable).access == spec::Access::ReadClears ? effect::clears : effect::senses;
  return add(term);
}

std::uint32_t Code::element() {
  Term term;
  term.kind = TermKind::Element;
  term.effects = effect::faults | effect::elements;
  return add(term);
}

std::uint32_t Code::binary(Operator op, std::uint32_t left, std::uint32_t right) {
  const bool low = spec::info(op).level == spec::Level::Low;
  if (is_number(left) && is_number(right))
    if (const auto value = bytecode::calculate(op, terms[left].value, terms[right].value))
      return number(*value);
  // x + -3 is x - 3, and x - -3 is x + 3.
  if (is_number(right) && (op == Operator::Add || op == Operator::Subtract)) {
    const auto value = terms[right].value;
    if (value == 0)
      return left;
    if (value < 0 && value != std::numeric_limits<std::int32_t>::min())
      return binary(op == Operator::Add ? Operator::Subtract : Operator::Add, left, number(-value));
    // (x + 3) - 1 is x + 2
    const auto inner = terms[left];
    if (inner.kind == TermKind::Binary && is_number(inner.right) &&
        (static_cast<Operator>(inner.what) == Operator::Add ||
         static_cast<Operator>(inner.what) == Operator::Subtract)) {
      const auto before = static_cast<Operator>(inner.what) == Operator::Add
                              ? terms[inner.right].value
                              : bytecode::subtract(0, terms[inner.right].value);
      const auto sum =
          op == Operator::Add ? bytecode::add(before, value) : bytecode::subtract(before, value);
      return binary(Operator::Add, inner.left, number(sum));
    }
  }
  if (is_number(right) && terms[right].value == 1 &&
      (op == Operator::Multiply || op == Operator::Divide))
    return left;
  const auto idle = op == Operator::Add ? 0 : 1;
  if (is_number(left) && (op == Operator::Add || op == Operator::Multiply) &&
      terms[left].value == idle)
    return right;
  // A leading number saves nothing, but a leading 0 - x before + can go: -5 + x is x - 5.
  if (is_number(left) && op == Operator::Add && terms[left].value < 0 &&
      terms[left].value != std::numeric_limits<std::int32_t>::min())
    return binary(Operator::Subtract, right, number(-terms[left].value));
  // x - (0 - y) is x + y, x + (0 - y) is x - y
  if (low && terms[right].kind == TermKind::Binary &&
      static_cast<Operator>(terms[right].what) == Operator::Subtract &&
      is_number(terms[right].left) && terms[terms[right].left].value == 0 &&
      (op == Operator::Add || op == Operator::Subtract))
    return binary(op == Operator::Add ? Operator::Subtract : Operator::Add, left,
                  terms[right].right);
  Term term;
  term.kind = TermKind::Binary;
  term.what = static_cast<std::uint8_t>(op);
  term.left = left;
  term.right = right;
  term.effects = static_cast<std::uint8_t>(terms[left].effects | terms[right].effects |
                                           (may_fault(op, terms[right]) ? effect::faults : 0));
  term.size =
      static_cast<std::uint16_t>(std::min<int>(terms[left].size + terms[right].size + 1, 0xFFFF));
  term.levels = levels_of(*this, op, left, right);
  return add(term);
}

std::uint32_t Code::call(spec::Function function, std::uint32_t operand) {
  const auto& inner = terms[operand];
  if (inner.kind == TermKind::Number && function == spec::Function::Abs)
    return number(bytecode::absolute(inner.value));
  Term term;
  term.kind = TermKind::Call;
  term.what = static_cast<std::uint8_t>(function);
  term.left = operand;
  term.effects = inner.effects;
  if (may_fault(function, inner))
    term.effects |= effect::faults;
  if (function == spec::Function::Rnd)
    term.effects |= effect::clears;
  term.size = static_cast<std::uint16_t>(std::min<int>(inner.size + 1, 0xFFFF));
  term.levels = saturated(inner.levels + (function_needs_parentheses(*this, operand) ? 2 : 1));
  return add(term);
}

std::uint32_t Code::copy(std::uint32_t term) {
  auto node = terms[term];
  if (node.kind == TermKind::Binary || node.kind == TermKind::Call)
    node.left = copy(node.left);
  if (node.kind == TermKind::Binary)
    node.right = copy(node.right);
  return add(node);
}

bool can_fault(const Code& code, std::uint32_t term, std::uint32_t variable) {
  const auto& node = code.terms[term];
  bool reads = false;
  each_read(code, term, [&](std::uint32_t v) { reads = reads || v == variable; });
  if (!reads)
    return false;
  switch (node.kind) {
  case TermKind::Number:
  case TermKind::Variable:
  case TermKind::System: return false;
  case TermKind::Element: return true;
  case TermKind::Binary:
    return may_fault(static_cast<Operator>(node.what), code.terms[node.right]) ||
           can_fault(code, node.left, variable) || can_fault(code, node.right, variable);
  case TermKind::Call:
    return may_fault(static_cast<spec::Function>(node.what), code.terms[node.left]) ||
           can_fault(code, node.left, variable);
  }
  return false;
}

bool same(const Code& code, std::uint32_t a, std::uint32_t b) {
  const auto& x = code.terms[a];
  const auto& y = code.terms[b];
  if (x.kind != y.kind || x.what != y.what || x.effects != y.effects)
    return false;
  switch (x.kind) {
  case TermKind::Number: return x.value == y.value;
  case TermKind::Variable: return x.left == y.left;
  case TermKind::Element:
  case TermKind::System: return true;
  case TermKind::Binary: return same(code, x.left, y.left) && same(code, x.right, y.right);
  case TermKind::Call: return same(code, x.left, y.left);
  }
  return false;
}

bool may_fault(const Code& code, const CodeLine& line) {
  if ((line.kind == LineKind::SetElement && !line.proven) || line.kind == LineKind::SetSystem ||
      line.kind == LineKind::On)
    return true;
  if ((effects_of(code, line) & effect::faults) != 0)
    return true;
  if (line.kind != LineKind::Do)
    return false;
  const auto parameters = spec::info(line.robot).parameters();
  for (auto n = line.parts_begin; n < line.parts_end; ++n) {
    const auto& part = code.parts[n];
    const auto which = n - line.parts_begin;
    if (part.kind != PartKind::Term || which >= parameters.size())
      return true;
    const auto range = code.is_number(part.value)
                           ? compiler::Range::only(code.terms[part.value].value)
                           : part.range;
    if (range.lo < parameters[which].least || range.hi > parameters[which].greatest)
      return true;
  }
  return false;
}

bool needs_parentheses(const Term& operand, Operator op, Side side) {
  if (operand.kind == TermKind::Call)
    return side == Side::Left;
  const bool binary =
      operand.kind == TermKind::Binary || (operand.kind == TermKind::Number && operand.value < 0);
  if (!binary)
    return false;
  const auto inner = is_low(operand) ? spec::Level::Low : spec::Level::Medium;
  const auto outer = spec::info(op).level;
  return side == Side::Left ? inner < outer : inner <= outer;
}

std::uint8_t levels_of(const Code& code, Operator op, std::uint32_t left, std::uint32_t right) {
  const auto of = [&](std::uint32_t operand, Side side) {
    const auto& term = code.terms[operand];
    const bool open = needs_parentheses(term, op, side) || ends_in_function(code, operand);
    return term.levels + (open ? 1 : 0);
  };
  return saturated(std::max(of(left, Side::Left), of(right, Side::Right)));
}

bool function_needs_parentheses(const Code& code, std::uint32_t operand) {
  const auto& term = code.terms[operand];
  if (is_low(term))
    return true;
  if (term.kind != TermKind::Binary)
    return false;
  // An expression that starts with a parenthesis looks as if it ended at the closing one.
  auto first = term;
  while (first.kind == TermKind::Binary) {
    const auto& left = code.terms[first.left];
    if (needs_parentheses(left, static_cast<Operator>(first.what), Side::Left) ||
        ends_in_function(code, first.left))
      return true;
    first = left;
  }
  return false;
}

bool ends_in_function(const Code& code, std::uint32_t index) {
  while (code.terms[index].kind == TermKind::Binary) {
    const auto& term = code.terms[index];
    if (needs_parentheses(code.terms[term.right], static_cast<Operator>(term.what), Side::Right))
      return false;
    index = term.right;
  }
  return code.terms[index].kind == TermKind::Call;
}

Moved moved_side(const Code& code, const Relation& relation) {
  const bool up = relation.comparison == Comparison::LessEqual;
  const auto deepest = spec::value_of(spec::Limit::ExpressionLevels);
  const auto can_move = [&](std::uint32_t term, compiler::Range range, bool raised) {
    if (code.is_number(term))
      range = compiler::Range::only(code.terms[term].value);
    else if (code.terms[term].levels >= deepest)
      return false; // a function at its end would need parentheses
    return raised ? range.hi < std::numeric_limits<std::int32_t>::max()
                  : range.lo > std::numeric_limits<std::int32_t>::min();
  };
  const bool left = can_move(relation.left, relation.left_range, !up);
  const bool right = can_move(relation.right, relation.right_range, up);
  if (left && (code.is_number(relation.left) || !right))
    return Moved::Left;
  return right ? Moved::Right : Moved::Neither;
}

Sum sum_of(const Code& code, std::uint32_t term) {
  const auto& node = code.terms[term];
  if (node.kind == TermKind::Number)
    return {none, node.value};
  const bool adds = node.what == static_cast<int>(Operator::Add);
  if (node.kind != TermKind::Binary || !code.is_number(node.right) ||
      (!adds && node.what != static_cast<int>(Operator::Subtract)))
    return {term, 0};
  const std::int64_t number = code.terms[node.right].value;
  return {node.left, adds ? number : -number};
}

std::vector<std::uint32_t> reads_of(const Code& code) {
  std::vector<std::uint32_t> reads(code.variables.size(), 0);
  for (const auto& line : code.lines)
    each_line_read(code, line, [&](std::uint32_t v) { ++reads[v]; });
  return reads;
}

} // namespace orb::structured
