#include "structured/lower/lowering.h"

#include "spec/limits.h"

#include <algorithm>

namespace orb::structured::lowering {
namespace {

using spec::Operator;

constexpr std::uint16_t largest_term = 64;

} // namespace

std::uint32_t Lowering::pop() {
  const auto term = pending_.back();
  pending_.pop_back();
  return term;
}

void Lowering::settle(std::uint8_t effects) {
  std::vector<std::size_t> early;
  for (auto i = pending_.size(); i-- > 0;)
    if (const auto own = code_.terms[pending_[i]].effects; ordered(own, effects)) {
      effects |= own;
      early.push_back(i);
    }
  for (auto i = early.rbegin(); i != early.rend(); ++i)
    pending_[*i] = read_temporary(pending_[*i]);
}

void Lowering::settle_calls(std::size_t end) {
  for (std::size_t i = 0; i < end; ++i) {
    const auto& term = code_.terms[pending_[i]];
    const bool temporary = term.kind == TermKind::Variable && term.left != index_variable &&
                           code_.variables[term.left].symbol == none && !is_result(term.left);
    if (term.kind != TermKind::Number && !temporary)
      pending_[i] = read_temporary(pending_[i]);
  }
}

bool Lowering::is_result(std::uint32_t variable) const {
  return std::find(result_of_.begin(), result_of_.end(), variable) != result_of_.end();
}

std::uint32_t Lowering::spill(std::uint32_t term) {
  settle(code_.terms[term].effects);
  return read_temporary(term);
}

std::uint32_t Lowering::binary(Operator op, std::uint32_t left, std::uint32_t right) {
  const auto most = spec::value_of(spec::Limit::ExpressionLevels);
  while (levels_of(code_, op, left, right) > most ||
         code_.terms[left].size + code_.terms[right].size > largest_term) {
    const auto& a = code_.terms[left];
    const auto& b = code_.terms[right];
    const bool right_is_worse = b.levels > a.levels || (b.levels == a.levels && b.size >= a.size);
    if (right_is_worse && !code_.is_leaf(right)) {
      if (ordered(a.effects, b.effects))
        left = spill(left);
      right = spill(right);
    } else {
      left = spill(left);
    }
  }
  return code_.binary(op, left, right);
}

std::uint32_t Lowering::call(spec::Function function, std::uint32_t operand) {
  const auto most = spec::value_of(spec::Limit::ExpressionLevels);
  const auto term = code_.call(function, operand);
  if (code_.terms[term].levels <= most)
    return term;
  return code_.call(function, spill(operand));
}

void Lowering::push_value(std::uint32_t root, Unit unit) {
  for (auto n = program_.nodes[root].first; n <= root; ++n) {
    push_node(n, unit);
    written_as(program_.nodes[n].span, pending_.back());
  }
}

std::uint32_t Lowering::value(std::uint32_t root, Unit unit) {
  push_value(root, unit);
  return pop();
}

void Lowering::push_node(std::uint32_t n, Unit unit) {
  const auto& node = program_.nodes[n];
  switch (node.kind) {
  case NodeKind::Number: push(code_.number(node.value)); return;
  case NodeKind::Duration:
    push(code_.number(unit == Unit::Seconds ? node.value / 1000 : node.value));
    return;
  case NodeKind::Name: push(name(names_.of_node[n])); return;
  case NodeKind::System: push(code_.system(static_cast<spec::Variable>(node.what))); return;
  case NodeKind::Element: {
    const auto index = pop();
    point_at(names_.of_node[n], index);
    settle(effect::faults);
    push(code_.read(into_temporary(code_.element())));
    return;
  }
  case NodeKind::Call: push_call(n); return;
  case NodeKind::Builtin: push(call(static_cast<spec::Function>(node.what), pop())); return;
  case NodeKind::Least: push_choice(Comparison::LessEqual); return;
  case NodeKind::Greatest: push_choice(Comparison::GreaterEqual); return;
  case NodeKind::Negate: {
    const auto operand = pop();
    push(binary(Operator::Subtract, code_.number(0), operand));
    return;
  }
  case NodeKind::Binary: {
    const auto right = pop();
    const auto left = pop();
    push(binary(static_cast<Operator>(node.what), left, right));
    return;
  }
  case NodeKind::Relation:
  case NodeKind::Not:
  case NodeKind::And:
  case NodeKind::Or: push(code_.number(0)); return; // reported: a condition is not a value
  }
}

std::uint32_t Lowering::name(std::uint32_t symbol) {
  if (symbol == none)
    return code_.number(0);
  if (names_.symbols[symbol].kind == SymbolKind::Constant)
    return code_.number(names_.symbols[symbol].value);
  return code_.read(variable_of(symbol));
}

void Lowering::push_choice(Comparison keeps) {
  const auto second = pop();
  const auto first = pop();
  const auto effects =
      static_cast<std::uint8_t>(code_.terms[first].effects | code_.terms[second].effects);
  // `RGB min(h, 255), 255 - min(h, 255), 0`: reuse the result, nothing has changed in between.
  if (last_choice_.end == code_.lines.size() && last_choice_.keeps == keeps && effects == 0 &&
      same(code_, last_choice_.first, first) && same(code_, last_choice_.second, second)) {
    push(code_.read(last_choice_.result));
    return;
  }
  settle(effects);
  const auto result = into_temporary(first);
  const auto compared = code_.is_leaf(second) ? second : code_.read(into_temporary(second));
  const auto done = new_label();
  go_if(keeps, code_.read(result), compared, done);
  let(result, compared);
  label(done);
  last_choice_ = {keeps, first, second, result, code_.lines.size()};
  push(code_.read(result));
}

void Lowering::point_at(std::uint32_t array, std::uint32_t index) {
  if (array == none)
    return;
  const auto& symbol = names_.symbols[array];
  const auto most = spec::value_of(spec::Limit::IndexedVariables);
  settle(code_.terms[index].effects);
  const auto element = binary(Operator::Add, index, code_.number(symbol.base));
  const bool known = code_.is_number(element);
  let(index_variable, element);
  if (known)
    return; // a wrong one is already reported
  const auto first = symbol.base + 1;
  const auto last = symbol.base + symbol.value;
  const auto good = new_label();
  const auto bad = new_label();
  const auto test = [&](Comparison comparison, std::int32_t bound, std::uint32_t target) {
    go_if(comparison, code_.read(index_variable), code_.number(bound), target);
    code_.lines.back().guard = true;
  };
  if (first > 1 && last < most) {
    test(Comparison::Less, first, bad);
    test(Comparison::LessEqual, last, good);
  } else if (first > 1) {
    test(Comparison::GreaterEqual, first, good);
  } else if (last < most) {
    test(Comparison::LessEqual, last, good);
  } else {
    return; // the robot's own limits
  }
  label(bad);
  let(index_variable, code_.number(0));
  code_.lines.back().guard = true;
  label(good);
}

} // namespace orb::structured::lowering
