#include "structured/lower/lowering.h"

#include <algorithm>
#include <utility>

namespace orb::structured::lowering {
namespace {

using spec::Operator;

When other(When when) {
  return when == When::Holds ? When::Fails : When::Holds;
}

} // namespace

// ---- conditions

void Lowering::branch(std::uint32_t root, When when, std::uint32_t label) {
  const auto& node = program_.nodes[root];
  if (node.kind == NodeKind::Not) {
    branch(root - 1, other(when), label);
  } else if (node.kind == NodeKind::And || node.kind == NodeKind::Or) {
    branch_chain(root, when, label);
  } else if (node.kind == NodeKind::Relation) {
    if (branch_choice(root, when, label))
      return;
    push_value(program_.before(root - 1));
    push_value(root - 1);
    const auto right = pop();
    const auto left = pop();
    compare(static_cast<Comparison>(node.what), left, right, when, label);
  } else {
    compare(Comparison::NotEqual, value(root), code_.number(0), when, label);
  }
}

void Lowering::compare(Comparison comparison, std::uint32_t left, std::uint32_t right, When when,
                       std::uint32_t label) {
  if (when == When::Fails)
    comparison = opposite(comparison);
  if (code_.is_number(left) && !code_.is_number(right)) {
    std::swap(left, right);
    comparison = mirrored(comparison);
  }
  go_if(comparison, left, right, label);
}

bool Lowering::branch_choice(std::uint32_t root, When when, std::uint32_t label) {
  const auto& nodes = program_.nodes;
  const auto is_choice = [&](std::uint32_t n) {
    return nodes[n].kind == NodeKind::Least || nodes[n].kind == NodeKind::Greatest;
  };
  auto comparison = static_cast<Comparison>(nodes[root].what);
  const auto first = program_.before(root - 1);
  const bool on_left = is_choice(first);
  const auto choice = on_left ? first : root - 1;
  if (comparison == Comparison::Equal || comparison == Comparison::NotEqual || !is_choice(choice))
    return false;
  if (!on_left)
    push_value(first);
  push_value(program_.before(choice - 1));
  push_value(choice - 1);
  if (on_left)
    push_value(root - 1);
  const auto third = pop();
  const auto second = pop();
  const auto first_term = pop();
  const auto a = on_left ? first_term : second;
  const auto b = on_left ? second : third;
  const auto limit = on_left ? third : first_term;
  const bool greatest = nodes[choice].kind == NodeKind::Greatest;
  const auto effects = code_.terms[a].effects | code_.terms[b].effects | code_.terms[limit].effects;
  constexpr std::uint16_t small = 3; // it is written twice
  if (!is_pure(static_cast<std::uint8_t>(effects)) || code_.terms[limit].size > small) {
    if (!on_left)
      push(limit);
    push(a);
    push(b);
    push_choice(greatest ? Comparison::GreaterEqual : Comparison::LessEqual);
    const auto chosen = pop();
    compare(comparison, on_left ? chosen : pop(), on_left ? limit : chosen, when, label);
    return true;
  }
  comparison = on_left ? comparison : mirrored(comparison);
  const auto taken = when == When::Fails ? opposite(comparison) : comparison;
  const bool above = taken == Comparison::Greater || taken == Comparison::GreaterEqual;
  if (above == greatest) { // either works
    compare(comparison, a, limit, when, label);
    compare(comparison, b, code_.copy(limit), when, label);
    return true;
  }
  const auto skip = new_label();
  compare(comparison, a, limit, other(when), skip);
  compare(comparison, b, code_.copy(limit), when, label);
  this->label(skip);
  return true;
}

void Lowering::branch_chain(std::uint32_t root, When when, std::uint32_t label) {
  const auto kind = program_.nodes[root].kind;
  std::vector<std::uint32_t> operands;
  auto at = root;
  for (; program_.nodes[at].kind == kind; at = program_.before(at - 1))
    operands.push_back(at - 1);
  operands.push_back(at);
  std::reverse(operands.begin(), operands.end());
  const bool each_decides = (kind == NodeKind::Or) == (when == When::Holds);
  if (each_decides) {
    for (const auto operand : operands)
      branch(operand, when, label);
    return;
  }
  const auto skip = new_label();
  for (std::size_t n = 0; n + 1 < operands.size(); ++n)
    branch(operands[n], other(when), skip);
  branch(operands.back(), when, label);
  this->label(skip);
}

// ---- blocks

std::uint32_t Lowering::conditional(std::uint32_t i) {
  const auto end = new_label();
  auto part = i;
  while (at(part).kind != Kind::EndIf) {
    const auto next = at(part).next;
    origin_ = part;
    if (at(part).kind == Kind::Else) {
      block(part + 1, next);
    } else {
      const auto skip = new_label();
      branch(item(at(part), 0).value, When::Fails, skip);
      block(part + 1, next);
      if (at(next).kind != Kind::EndIf)
        go(end);
      label(skip);
    }
    part = next;
  }
  label(end);
  return part + 1;
}

std::uint32_t Lowering::while_loop(std::uint32_t i) {
  const auto end = at(i).next;
  const auto top = new_label();
  const auto test = new_label();
  const auto exit = new_label();
  go(test);
  label(top);
  in_loop(exit, test, [&] { block(i + 1, end); });
  origin_ = i;
  label(test);
  branch(item(at(i), 0).value, When::Holds, top);
  label(exit);
  return end + 1;
}

std::uint32_t Lowering::repeat_until(std::uint32_t i) {
  const auto end = at(i).next;
  const auto top = new_label();
  const auto test = new_label();
  const auto exit = new_label();
  label(top);
  in_loop(exit, test, [&] { block(i + 1, end); });
  origin_ = end;
  label(test);
  branch(item(at(end), 0).value, When::Fails, top);
  label(exit);
  return end + 1;
}

std::uint32_t Lowering::endless(std::uint32_t i) {
  const auto end = at(i).next;
  const auto top = new_label();
  const auto exit = new_label();
  label(top);
  in_loop(exit, top, [&] { block(i + 1, end); });
  origin_ = end;
  go(top);
  label(exit);
  return end + 1;
}

std::uint32_t Lowering::repeat_times(std::uint32_t i) {
  const auto end = at(i).next;
  const auto times = value(item(at(i), 0).value);
  const auto counter = code_.new_variable();
  const auto exit = new_label();
  const auto again = new_label();
  if (plan_.native[i]) {
    const auto last = kept(times);
    let(counter, code_.number(1));
    native(i, end, counter, code_.number(1), last, 1, exit, again);
    return end + 1;
  }
  const auto top = new_label();
  const auto test = new_label();
  let(counter, times);
  go(test);
  label(top);
  in_loop(exit, again, [&] { block(i + 1, end); });
  origin_ = end;
  label(again);
  let(counter, code_.binary(Operator::Subtract, code_.read(counter), code_.number(1)));
  label(test);
  go_if(Comparison::Greater, code_.read(counter), code_.number(0), top);
  label(exit);
  return end + 1;
}

std::uint32_t Lowering::counting(std::uint32_t i) {
  const auto& node = at(i);
  const auto end = node.next;
  const auto symbol = names_.of_node[item(node, 0).value];
  const auto counter = symbol == none ? code_.new_variable() : variable_of(symbol);
  const auto step = size(node) > 3 ? evaluate(program_, names_, item(node, 3).value)->value : 1;
  const auto first = value(item(node, 1).value);
  let(counter, first);
  const auto bound = value(item(node, 2).value);
  constexpr std::uint16_t small = 3; // shorter to recompute than to store on a line
  const bool twice =
      plan_.native[i] && code_.terms[bound].effects == 0 && code_.terms[bound].size <= small;
  const auto last = twice ? bound : kept(bound);
  const auto exit = new_label();
  const auto again = new_label();
  if (plan_.native[i]) {
    native(i, end, counter, first, last, step, exit, again);
    return end + 1;
  }
  const auto top = new_label();
  const auto test = new_label();
  go(test);
  label(top);
  in_loop(exit, again, [&] { block(i + 1, end); });
  origin_ = end;
  label(again);
  let(counter, code_.binary(Operator::Add, code_.read(counter), code_.number(step)));
  label(test);
  go_if(step > 0 ? Comparison::LessEqual : Comparison::GreaterEqual, code_.read(counter), last,
        top);
  label(exit);
  return end + 1;
}

void Lowering::native(std::uint32_t i, std::uint32_t end, std::uint32_t counter,
                      std::uint32_t first, std::uint32_t last, std::int32_t step,
                      std::uint32_t exit, std::uint32_t again) {
  const auto begin = [&] {
    return code_.is_number(first) ? code_.copy(first) : code_.read(counter);
  };
  go_if(step > 0 ? Comparison::Greater : Comparison::Less, begin(), last, exit);
  auto& line = emit(LineKind::For);
  line.variable = counter;
  line.term = begin();
  line.end = code_.copy(last);
  line.step = step;
  const auto top = new_label();
  line.label = top;
  label(top);
  in_loop(exit, again, [&] { block(i + 1, end); });
  origin_ = end;
  label(again);
  auto& next = emit(LineKind::Next);
  next.variable = counter;
  next.label = top;
  next.step = step;
  label(exit);
}

std::uint32_t Lowering::selection(std::uint32_t i) {
  const auto chosen = into_temporary(value(item(at(i), 0).value));
  const auto exit = new_label();
  auto otherwise = exit;
  std::vector<Case> cases;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bodies; // case number and label
  auto part = at(i).next;
  for (; at(part).kind != Kind::EndSelect; part = at(part).next) {
    const auto body = new_label();
    bodies.push_back({part, body});
    if (at(part).kind == Kind::Else)
      otherwise = body;
    else
      add_cases(at(part), body, cases);
  }
  auto& line = emit(LineKind::Switch);
  line.variable = chosen;
  line.label = otherwise;
  line.parts_begin = static_cast<std::uint32_t>(code_.cases.size());
  code_.cases.insert(code_.cases.end(), cases.begin(), cases.end());
  line.parts_end = static_cast<std::uint32_t>(code_.cases.size());
  for (const auto& [body, start] : bodies) {
    origin_ = body;
    label(start);
    block(body + 1, at(body).next);
    go(exit);
  }
  label(exit);
  return part + 1;
}

void Lowering::add_cases(const Statement& node, std::uint32_t body,
                         std::vector<Case>& cases) const {
  const auto number = [&](std::uint32_t n) {
    return evaluate(program_, names_, item(node, n).value)->value;
  };
  for (std::uint32_t n = 0; n < size(node); ++n) {
    const bool range = n + 2 < size(node) && item(node, n + 1).kind == ItemKind::To;
    cases.push_back({number(n), number(range ? n + 2 : n), body});
    n += range ? 2 : 0;
  }
}

} // namespace orb::structured::lowering
