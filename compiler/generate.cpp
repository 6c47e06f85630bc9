#include "compiler/generator.h"

namespace orb::compiler {

Chunk Generator::run() {
  for (std::uint32_t i = 0; i < program_.lines.size(); ++i)
    if (program_.lines[i].has_number())
      line_of_.try_emplace(program_.lines[i].number, i); // the first of duplicates counts, A-26
  begins_.assign(program_.lines.size() + 1, 0);
  for (std::uint32_t i = 0; i < program_.lines.size(); ++i) {
    const auto& line = program_.lines[i];
    begins_[i] = here();
    if (!line.has_statement())
      continue;
    const auto number = line.number <= UINT16_MAX ? line.number : 0;
    chunk_.lines.push_back({static_cast<std::uint16_t>(number), here()});
    statement(program_.statements[line.statement]);
    if (overflow_)
      give_up(begins_[i]);
  }
  begins_[program_.lines.size()] = here();
  emit(Op::EndOfProgram);
  resolve();
  return std::move(chunk_);
}

std::uint32_t Generator::emit(Op op, std::uint16_t a, std::uint16_t b, std::uint16_t c,
                              std::uint16_t d) {
  chunk_.code.push_back({op, false, a, b, c, d, 0});
  return here() - 1;
}

bool Generator::lead_to(std::uint32_t at, std::uint32_t number) {
  const auto found = line_of_.find(number);
  if (found == line_of_.end())
    return false;
  jumps_.emplace_back(at, found->second);
  return true;
}

void Generator::resolve() {
  for (const auto& [at, line] : jumps_)
    chunk_.code[at].target = begins_[line];
  const std::uint16_t first = chunk_.first_constant();
  const auto place = [&](std::uint16_t& operand, char kind) {
    if (kind == 'r' && operand >= constant_mark)
      operand = static_cast<std::uint16_t>(operand - constant_mark + first);
  };
  for (auto& instruction : chunk_.code) {
    const auto operands = bytecode::info(instruction.op).operands;
    place(instruction.a, operands[0]);
    place(instruction.b, operands[1]);
    place(instruction.c, operands[2]);
    place(instruction.d, operands[3]);
  }
}

void Generator::give_up(std::uint32_t begin) {
  overflow_ = false;
  chunk_.code.resize(begin);
  while (!jumps_.empty() && jumps_.back().first >= begin)
    jumps_.pop_back();
  trap(BasicError::ExpressionTooComplex);
}

bool Generator::is_last(Op op, std::uint16_t to, std::uint32_t end) const {
  return is_temporary(to) && chunk_.code[end - 1].op == op && chunk_.code[end - 1].a == to;
}

void Generator::statement(const StatementNode& node) {
  stack_.clear();
  if (node.error) {
    trap(*node.error);
    return;
  }
  const auto items = program_.items_of(node);
  switch (node.kind) {
  case Statement::Let: assign(program_.as<LetView>(node)); return;
  case Statement::If: decide(node); return;
  case Statement::For: begin_loop(program_.as<ForView>(node)); return;
  case Statement::Next: end_loop(program_.as<NextView>(node).variable); return;
  case Statement::Goto: branch(Op::Goto, program_.as<BranchView>(node)); return;
  case Statement::Gosub: branch(Op::Gosub, program_.as<BranchView>(node)); return;
  case Statement::Return: emit(Op::Return); return;
  case Statement::On:
    choose(node.spelling == Spelling::OnGosub ? Op::OnGosub : Op::OnGoto,
           program_.as<OnView>(node));
    return;
  case Statement::Print: print(items); return;
  case Statement::Input: input(program_.as<InputView>(node)); return;
  case Statement::Delay:
    if (const auto time = value(items[0].value))
      emit(Op::Delay, *time);
    return;
  case Statement::End: emit(Op::End); return;
  case Statement::Data: data(items); return;
  case Statement::Rstr: emit(Op::RestartData); return;
  case Statement::Read: read(items); return;
  case Statement::Random: emit(Op::Random); return;
  case Statement::Tron: emit(Op::Tron); return;
  case Statement::Troff: emit(Op::Troff); return;
  case Statement::Reset: emit(Op::Reset); return;
  // clang-format off
  case Statement::Rgb: case Statement::Ledc: case Statement::BackLed: case Statement::Goroll:
  case Statement::Heading: case Statement::Raw: case Statement::Locate: case Statement::Basflg:
  case Statement::Sleep: case Statement::Macrun: case Statement::Mackill:
    perform(node.kind, items); return;
    // clang-format on
  }
}

void Generator::store(const Item& variable, std::uint16_t from) {
  if (variable.kind == ItemKind::Letter)
    move(static_cast<std::uint16_t>(variable.value), from);
  else if (variable.kind == ItemKind::Indexed)
    emit(Op::StoreElement, from);
  else
    emit(Op::WriteSystem, static_cast<std::uint16_t>(variable.value), from);
}

void Generator::assign(const LetView& let) {
  const auto from = value(let.expression.value);
  if (!from)
    return;
  store(let.variable, *from);
  end_line();
}

bool Generator::select(const StatementNode& node, Relation relation, std::uint16_t left,
                       std::uint16_t right) {
  if (node.else_branch == none)
    return false;
  const auto& then = program_.statements[node.then_branch];
  const auto& otherwise = program_.statements[node.else_branch];
  if (then.kind != Statement::Let || then.error || otherwise.kind != Statement::Let ||
      otherwise.error)
    return false;
  const auto x = program_.as<LetView>(then);
  const auto y = program_.as<LetView>(otherwise);
  if (x.variable.kind != ItemKind::Letter || y.variable.kind != ItemKind::Letter ||
      x.variable.value != y.variable.value)
    return false;
  const Item values[] = {x.expression, y.expression};
  const std::uint32_t begin = here();
  const auto pair = side_by_side(values);
  const bool harmless =
      std::all_of(chunk_.code.begin() + begin, chunk_.code.end(), [](const auto& made) {
        return info(made.op).compiled == bytecode::Compiled::Wholly;
      });
  stack_.resize(2); // left and right
  if (!harmless) {
    chunk_.code.resize(begin);
    return false;
  }
  const auto to = static_cast<std::uint16_t>(x.variable.value);
  if (relation == Relation::Equal && constant_in(right) == 0 && is_last(Op::And, left, begin)) {
    const auto bits = chunk_.code[begin - 1];
    chunk_.code.erase(chunk_.code.begin() + begin - 1);
    emit(Op::SelectClear, to, bits.b, bits.c, *pair);
  } else {
    emit(with_relation(Op::SelectEqual, relation), to, left, right, *pair);
  }
  return true;
}

void Generator::branch(Op op, const BranchView& branch) {
  const std::uint32_t at = emit(op);
  if (lead_to(at, branch.target.value))
    chunk_.code[at].ends_line = op == Op::Goto;
  else
    chunk_.code[at] = {Op::Trap, false, spec::code(BasicError::BadLineNumber)};
}

void Generator::choose(Op op, const OnView& on) {
  const auto index = value(on.selector.value);
  if (!index)
    return;
  emit(op, *index, static_cast<std::uint16_t>(on.targets.size()));
  for (const auto& target : on.targets) {
    const std::uint32_t row = emit(Op::Target);
    if (!lead_to(row, target.value))
      chunk_.code[row].a = spec::code(BasicError::BadLineNumber);
  }
}

void Generator::begin_loop(const ForView& loop) {
  const auto start = value(loop.start.value);
  if (!start)
    return;
  const bool letter = loop.variable.kind == ItemKind::Letter;
  const auto variable = static_cast<std::uint16_t>(loop.variable.value);
  const bool simple =
      letter && is_leaf(loop.end.value) && (loop.step == nullptr || is_leaf(loop.step->value));
  if (!simple) // the start is assigned before end and step are evaluated
    store(loop.variable, *start);
  const auto end = value(loop.end.value);
  if (!end)
    return;
  const auto step = loop.step != nullptr ? value(loop.step->value) : constant(1);
  if (!step)
    return;
  if (letter)
    emit(Op::For, variable, simple ? *start : variable, *end, *step);
  else
    emit(Op::ForElement, 0, *end, *step);
}

void Generator::end_loop(const Item& variable) {
  const bool letter = variable.kind == ItemKind::Letter;
  emit(letter ? Op::Next : Op::NextElement, static_cast<std::uint16_t>(variable.value));
}

std::uint32_t Generator::leave_branch() {
  auto& last = chunk_.code.back();
  if (bytecode::info(last.op).ends != Ends::Either || last.op == Op::Goto)
    return none;
  last.ends_line = false;
  const std::uint32_t at = emit(Op::Goto);
  end_line();
  return at;
}

void Generator::print(std::span<const Item> items) {
  const bool open = !items.empty() && items.back().kind == ItemKind::Semicolon;
  for (const auto& item : items) {
    if (item.kind == ItemKind::Expression || item.kind == ItemKind::Character) {
      if (!value(item.value))
        return;
      emit(item.kind == ItemKind::Character ? Op::PrintCharacter : Op::PrintNumber, pop());
    } else if (item.kind == ItemKind::String) {
      text(program_.text_of(item.span));
    } else if (item.kind == ItemKind::Comma) {
      emit(Op::PrintBlank);
    } // only the last semicolon counts
  }
  emit(open ? Op::PrintOpen : Op::PrintLine);
}

void Generator::text(std::string_view quoted) {
  if (chunk_.texts.size() >= most_registers) {
    overflow_ = true;
    return;
  }
  emit(Op::PrintText, static_cast<std::uint16_t>(chunk_.texts.size()));
  chunk_.texts.emplace_back(quoted.substr(1, quoted.size() - 2));
}

void Generator::input(const InputView& input) {
  const auto variable = input.variable.kind == ItemKind::Letter
                            ? static_cast<std::uint16_t>(input.variable.value)
                            : bytecode::element_by_index;
  if (input.milliseconds == nullptr) {
    emit(Op::Input, variable);
    return;
  }
  const auto time = value(input.milliseconds->value);
  const auto fallback = time ? value(input.fallback->value) : std::nullopt;
  if (fallback)
    emit(Op::InputTimed, variable, *time, *fallback);
}

void Generator::data(std::span<const Item> items) {
  const auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues));
  const auto kept = items.first(std::min(items.size(), most)); // more are ignored
  if (const auto first = side_by_side(kept))
    emit(Op::SetData, *first, static_cast<std::uint16_t>(kept.size()));
}

void Generator::read(std::span<const Item> items) {
  for (const auto& item : items) {
    compute(Op::ReadData);
    store(item, pop());
  }
  end_line();
}

void Generator::perform(Statement kind, std::span<const Item> items) {
  const auto first = side_by_side(items);
  if (!first)
    return;
  // Without arguments, pass any valid register.
  emit(Op::Perform, static_cast<std::uint16_t>(kind), items.empty() ? std::uint16_t{0} : *first,
       static_cast<std::uint16_t>(items.size()));
}

bytecode::Chunk generate(const Program& program) {
  return Generator(program).run();
}

} // namespace orb::compiler
