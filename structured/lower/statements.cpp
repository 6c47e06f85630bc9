#include "structured/lower/lowering.h"

#include "structured/text/structured_words.h"

#include <utility>

namespace orb::structured::lowering {

using spec::Operator;

void Lowering::block(std::uint32_t from, std::uint32_t to) {
  for (auto i = from; i < to && !full();)
    i = statement(i);
}

std::uint32_t Lowering::statement(std::uint32_t i) {
  const auto& node = at(i);
  origin_ = i;
  switch (node.kind) {
  case Kind::Robot: robot(node); break;
  case Kind::Assign: assign(node); break;
  case Kind::Print: print(node); break;
  case Kind::Call: call_statement(i, node); break;
  case Kind::Return: leave(node); break;
  case Kind::Exit:
    if (!loops_.empty())
      go(loops_.back().exit);
    break;
  case Kind::Continue:
    if (!loops_.empty())
      go(loops_.back().again);
    break;
  case Kind::Label: label(user_label(node.name)); break;
  case Kind::Goto: go(user_label(node.name)); break;
  case Kind::If: return conditional(i);
  case Kind::While: return while_loop(i);
  case Kind::Repeat: return repeat_until(i);
  case Kind::RepeatTimes: return repeat_times(i);
  case Kind::Loop: return endless(i);
  case Kind::For: return counting(i);
  case Kind::Select: return selection(i);
  case Kind::Sub:
  case Kind::Function: return node.next == none ? i + 1 : node.next + 1;
  case Kind::Const:
  case Kind::Local:
  case Kind::Array:
  case Kind::Use:
  case Kind::Include:
  case Kind::ElseIf:
  case Kind::Else:
  case Kind::EndIf:
  case Kind::EndWhile:
  case Kind::Until:
  case Kind::EndRepeat:
  case Kind::EndLoop:
  case Kind::Next:
  case Kind::Case:
  case Kind::EndSelect:
  case Kind::EndSub:
  case Kind::EndFunction:
  case Kind::Broken: break;
  }
  return i + 1;
}

std::uint32_t Lowering::user_label(std::uint32_t name) {
  for (const auto& [other, label] : contexts_.back().labels)
    if (other == name)
      return label;
  contexts_.back().labels.push_back({name, new_label()});
  return contexts_.back().labels.back().second;
}

void Lowering::call_statement(std::uint32_t i, const Statement& node) {
  if (names_.of_statement[i] == none)
    return;
  for (std::uint32_t n = 0; n < size(node); ++n)
    push_value(item(node, n).value);
  call_routine(names_.symbols[names_.of_statement[i]].routine, size(node));
}

void Lowering::leave(const Statement& node) {
  const auto context = contexts_.back();
  if (size(node) > 0)
    let(result(context.routine), value(item(node, 0).value));
  if (context.return_label == none)
    emit(LineKind::Return);
  else
    go(context.return_label);
}

void Lowering::assign(const Statement& node) {
  const auto& target = item(node, 0);
  const auto& place = program_.nodes[target.value];
  const bool compound = node.operation != Statement::none_operation;
  const auto root = item(node, 1).value;
  if (place.kind == NodeKind::Element) {
    assign_element(node, target.value, root);
    return;
  }
  const bool system = place.kind == NodeKind::System;
  if (compound)
    push(written_as(target.span, system ? code_.system(static_cast<spec::Variable>(place.what))
                                        : name(names_.of_node[target.value])));
  push_value(root);
  auto term = pop();
  if (compound)
    term = written_as(node.span, binary(static_cast<Operator>(node.operation), pop(), term));
  if (system) {
    auto& line = emit(LineKind::SetSystem);
    line.variable = place.what;
    line.term = term;
  } else if (names_.of_node[target.value] != none) {
    let(variable_of(names_.of_node[target.value]), term);
  }
}

void Lowering::assign_element(const Statement& node, std::uint32_t place, std::uint32_t root) {
  const auto array = names_.of_node[place];
  push_value(place - 1);
  if (node.operation == Statement::none_operation) {
    push_value(root);
    const auto term = pop();
    const auto index = pop();
    pending_.push_back(term); // computed after the index
    auto below = std::exchange(pending_, {});
    point_at(array, index);
    pending_ = std::move(below);
    emit(LineKind::SetElement).term = pop();
    return;
  }
  auto index = pop();
  if (!code_.is_number(index))
    index = spill(index);
  point_at(array, index);
  push(code_.read(into_temporary(code_.element())));
  push_value(root);
  const auto right = pop();
  const auto left = pop();
  const auto term = binary(static_cast<Operator>(node.operation), left, right);
  if (array != none)
    let(index_variable,
        code_.binary(Operator::Add, index, code_.number(names_.symbols[array].base)));
  emit(LineKind::SetElement).term = term;
}

void Lowering::add_part(PartKind kind, std::uint32_t value, Span text) {
  code_.parts.push_back({kind, value, text, {}});
}

void Lowering::add_text(Span text) {
  add_part(PartKind::Text, none, texts_.try_emplace(program_.text_of(text), text).first->second);
}

void Lowering::print(const Statement& node) {
  const auto base = pending_.size();
  for (const auto& part : program_.items_of(node))
    if (part.kind == ItemKind::Expression || part.kind == ItemKind::Character)
      push_value(part.value);
  const auto begin = parts_now();
  auto next = base;
  for (std::uint32_t n = 0; n < size(node); ++n) {
    const auto& part = item(node, n);
    if (part.kind == ItemKind::Expression)
      add_part(PartKind::Term, pending_[next++]);
    else if (part.kind == ItemKind::Character)
      add_part(PartKind::Character, pending_[next++]);
    else if (part.kind == ItemKind::String)
      add_text({part.span.begin + 1, part.span.end - 1});
    else if (part.kind == ItemKind::Comma)
      add_part(PartKind::Blank, none);
    else if (n + 1 == size(node))
      add_part(PartKind::Open, none);
  }
  pending_.resize(base);
  finish(emit(LineKind::Print), begin);
}

void Lowering::finish(CodeLine& line, std::uint32_t begin) {
  line.parts_begin = begin;
  line.parts_end = parts_now();
}

void Lowering::perform(spec::Statement robot, std::uint32_t begin) {
  auto& line = emit(LineKind::Do);
  line.robot = robot;
  finish(line, begin);
}

void Lowering::robot(const Statement& node) {
  if (node.robot == spec::Statement::Read)
    return read(node);
  if (node.robot == spec::Statement::Input)
    return input(node);
  if (node.robot == spec::Statement::Sleep)
    return sleep(node);
  if (node.robot == spec::Statement::Rgb && size(node) == 1)
    return colour(node);
  const auto base = pending_.size();
  for (const auto& part : program_.items_of(node))
    push_value(part.value);
  const auto begin = parts_now();
  for (auto n = base; n < pending_.size(); ++n)
    add_part(PartKind::Term, pending_[n]);
  pending_.resize(base);
  perform(node.robot, begin);
}

void Lowering::colour(const Statement& node) {
  const auto& part = item(node, 0);
  const auto named = find_colour(program_.text_of(part.span));
  const auto colour = part.kind == ItemKind::Colour ? part.value : named.value_or(0);
  const auto begin = parts_now();
  for (const int shift : {16, 8, 0})
    add_part(PartKind::Term, code_.number(static_cast<std::int32_t>(colour >> shift & 0xFF)));
  perform(spec::Statement::Rgb, begin);
}

void Lowering::sleep(const Statement& node) {
  push_value(item(node, 0).value, Unit::Seconds);
  if (size(node) > 1)
    push_value(item(node, 1).value);
  else
    push(code_.number(0));
  const auto begin = parts_now();
  const auto macro = pop();
  add_part(PartKind::Term, pop());
  add_part(PartKind::Term, macro);
  if (size(node) > 2)
    add_part(PartKind::Restart, none);
  else
    add_part(PartKind::Term, code_.number(0));
  perform(spec::Statement::Sleep, begin);
}

void Lowering::read(const Statement& node) {
  auto begin = parts_now();
  const auto flush = [&] {
    if (parts_now() > begin)
      perform(spec::Statement::Read, begin);
    begin = parts_now();
  };
  for (const auto& part : program_.items_of(node)) {
    if (program_.nodes[part.value].kind == NodeKind::Element) {
      flush();
      const auto index = value(part.value - 1);
      point_at(names_.of_node[part.value], index);
      begin = parts_now();
      add_part(PartKind::Element, none);
      flush();
    } else {
      add_target(part.value);
    }
  }
  flush();
}

void Lowering::add_target(std::uint32_t place) {
  if (names_.of_node[place] != none)
    add_part(PartKind::Variable, variable_of(names_.of_node[place]));
}

void Lowering::input(const Statement& node) {
  const auto place = item(node, 0).value;
  const bool element = program_.nodes[place].kind == NodeKind::Element;
  if (element)
    push_value(place - 1);
  for (std::uint32_t n = 1; n < size(node); ++n)
    push_value(item(node, n).value);
  std::vector<std::uint32_t> terms(pending_.end() - (size(node) - 1), pending_.end());
  pending_.resize(pending_.size() - terms.size());
  if (element) {
    const auto index = pop();
    auto below = std::exchange(pending_, {});
    point_at(names_.of_node[place], index);
    pending_ = std::move(below);
  }
  const auto begin = parts_now();
  if (element)
    add_part(PartKind::Element, none);
  else
    add_target(place);
  for (const auto term : terms)
    add_part(PartKind::Term, term);
  perform(spec::Statement::Input, begin);
}

} // namespace orb::structured::lowering
