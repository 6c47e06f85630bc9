#if defined(ORB_NATIVE)
#include "vm/machine/native/writer.h"

namespace orb::vm::native {

Writer::Writer(const Chunk& chunk, const Plan& plan, x86::Assembler& assembler)
    : chunk_(chunk), plan_(plan), a_(assembler), homes_(chunk.register_count()) {
  for (std::size_t i = 0; i < chunk.code.size(); ++i)
    labels_.push_back(a_.newLabel());
  for (std::size_t i = 0; i < plan.steps().size(); ++i) {
    ins_.push_back(plan.is_called(i) || !plan.begins_block(i) ? a_.newLabel() : line_of(i));
    outs_.push_back(a_.newLabel());
  }
  for (std::size_t i = 0; i < plan.housed().size(); ++i)
    homes_[plan.housed()[i]] = homes[i];
  exit_ = a_.newLabel();
  table_ = a_.newLabel();
}

std::vector<Writer::CodePlace> Writer::program(const asmjit::StringLogger* log) {
  std::vector<CodePlace> places;
  const auto mark = [&] { places.push_back({a_.offset(), log ? log->dataSize() : 0}); };
  mark();
  enter();
  for (std::size_t i = 0; i < plan_.steps().size(); ++i) {
    if (!plan_.is_called(i))
      mark();
    write_step(i);
  }
  for (std::size_t i = 0; i < plan_.steps().size(); ++i)
    if (plan_.steps()[i].rest > 0)
      write_door(i);
  leave();
  mark();
  write_tables();
  return places;
}

void Writer::enter() {
  for (const auto& one : saved)
    a_.push(one);
  a_.push(x86::rdx);
  a_.push(x86::rsi);
  a_.push(x86::qword_ptr(x86::rsi, offsetof(Frames, loop)));
  a_.mov(r, x86::rdi);
  a_.mov(budget, x86::qword_ptr(x86::rdx));
  for (const auto index : plan_.housed())
    if (index < bytecode::first_temporary)
      a_.mov(*homes_[index], memory(index));
  a_.jmp(x86::rcx);
}

void Writer::leave() {
  a_.bind(exit_);
  for (const auto index : plan_.housed())
    if (index < bytecode::first_temporary)
      a_.mov(memory(index), *homes_[index]);
  a_.pop(x86::rdx);
  a_.pop(x86::rcx);
  a_.mov(x86::qword_ptr(x86::rcx, offsetof(Frames, loop)), x86::rdx);
  a_.pop(x86::rcx);
  a_.mov(x86::qword_ptr(x86::rcx), budget);
  for (auto one = saved.rbegin(); one != saved.rend(); ++one)
    a_.pop(*one);
  a_.ret();
}

void Writer::write_tables() {
  a_.align(asmjit::AlignMode::kData, sizeof(void*));
  a_.bind(table_);
  for (const auto& label : labels_)
    if (a_.code()->isLabelBound(label))
      a_.embedLabel(label);
    else
      a_.embedUInt64(0);
  for (const auto& [label, reciprocal] : reciprocals_) {
    a_.bind(label);
    a_.embedInt64(reciprocal);
  }
}

const Label& Writer::line_of(std::size_t step) const {
  return labels_[chunk_.begin(plan_.steps()[step].line)];
}

void Writer::write_step(std::size_t number) {
  const auto& step = plan_.steps()[number];
  const auto begin = chunk_.begin(step.line);
  a_.bind(ins_[number]);
  if (step.rest == 0) {
    leave_before(begin);
    return;
  }
  step_ = number;
  following_ = chunk_.begin(step.line + 1);
  leave_ = outs_[number];
  if (plan_.begins_block(number)) {
    a_.sub(budget, step.rest);
    a_.jc(leave_);
  }
  for (std::uint32_t at = begin + 1; at < following_; ++at)
    labels_[at] = a_.newLabel();
  for (std::uint32_t at = begin; at < following_; ++at) {
    if (at != begin)
      a_.bind(labels_[at]);
    write(at, chunk_.code[at]);
  }
}

void Writer::leave_before(std::uint32_t at) {
  a_.mov(x86::eax, at);
  a_.jmp(exit_);
}

void Writer::write_door(std::size_t number) {
  const auto& step = plan_.steps()[number];
  if (!plan_.is_called(number) && !plan_.begins_block(number)) {
    a_.bind(line_of(number));
    a_.sub(budget, step.rest);
    a_.jnc(ins_[number]);
  }
  a_.bind(outs_[number]);
  a_.add(budget, step.rest);
  if (plan_.is_called(number)) {
    load_calls();
    open_calls(step.calls);
  }
  leave_before(chunk_.begin(step.line));
}

void Writer::write(std::uint32_t at, const Instruction& i) {
  switch (i.op) {
  case Op::Copy: copy(i.a, i.b); break;
  case Op::Add: calculate(x86::Inst::kIdAdd, i.a, i.b, i.c); break;
  case Op::Subtract: calculate(x86::Inst::kIdSub, i.a, i.b, i.c); break;
  case Op::Multiply: multiply(i); break;
  case Op::And: calculate(x86::Inst::kIdAnd, i.a, i.b, i.c); break;
  case Op::Or: calculate(x86::Inst::kIdOr, i.a, i.b, i.c); break;
  case Op::Divide: divide(i, x86::eax); break;
  case Op::Remainder: divide(i, x86::edx); break;
  case Op::MultiplyAdd: multiply(i, i.d); break;
  case Op::DivideBy: divide_by(i); break;
  case Op::RemainderBy: remainder_by(i); break;
  case Op::DivideSubtract: divide_subtract(i); break;
  case Op::RemainderAdd: remainder_by(i, i.d); break;
  case Op::DivideByPower: divide_by_power(i); break;
  case Op::RemainderByPower: remainder_by_power(i); break;
  case Op::ShiftLeft: shift(x86::Inst::kIdShl, i); break;
  case Op::ShiftRight: shift(x86::Inst::kIdSar, i); break;
  case Op::Abs: absolute(i); break;
  case Op::LoadElement: load_element(i); break;
  case Op::StoreElement: store_element(i); break;
  case Op::UnlessEqual: test(i, x86::CondCode::kNE); break;
  case Op::UnlessNotEqual: test(i, x86::CondCode::kE); break;
  case Op::UnlessLess: test(i, x86::CondCode::kGE); break;
  case Op::UnlessGreater: test(i, x86::CondCode::kLE); break;
  case Op::WhenEqual: test(i, x86::CondCode::kE); break;
  case Op::WhenNotEqual: test(i, x86::CondCode::kNE); break;
  case Op::WhenLess: test(i, x86::CondCode::kL); break;
  case Op::WhenGreater: test(i, x86::CondCode::kG); break;
  case Op::SelectEqual: select(at, i, x86::CondCode::kE); break;
  case Op::SelectNotEqual: select(at, i, x86::CondCode::kNE); break;
  case Op::SelectLess: select(at, i, x86::CondCode::kL); break;
  case Op::SelectGreater: select(at, i, x86::CondCode::kG); break;
  case Op::SelectClear: select(at, i, x86::CondCode::kE); break;
  case Op::Goto: jump(at, i.target); break;
  case Op::For: begin_loop(at, i); break;
  case Op::Next: end_loop(at, i); break;
  case Op::Gosub: call(at, i); break;
  case Op::Return: come_back(); break;
  // clang-format off
  case Op::Sqrt: case Op::Rnd: case Op::ReadSystem: case Op::WriteSystem: case Op::ReadData:
  case Op::OnGoto: case Op::OnGosub: case Op::Target: case Op::ForElement: case Op::NextElement:
  case Op::End: case Op::EndOfProgram: case Op::Trap: case Op::PrintText: case Op::PrintNumber:
  case Op::PrintCharacter: case Op::PrintBlank: case Op::PrintLine: case Op::PrintOpen:
  case Op::Delay: case Op::Input: case Op::InputTimed: case Op::SetData: case Op::RestartData:
  case Op::Perform: case Op::Random: case Op::Tron: case Op::Troff: case Op::Reset: break;
    // clang-format on
  }
}

std::int32_t Writer::constant(std::uint16_t index) const {
  return chunk_.constants[index - chunk_.first_constant()];
}

Operand Writer::operand(std::uint16_t index) const {
  if (is_constant(index))
    return Imm(constant(index));
  return homes_[index] ? Operand(*homes_[index]) : Operand(memory(index));
}

void Writer::load(const x86::Gp& to, std::uint16_t index) {
  if (const auto from = operand(index); from != to)
    a_.emit(x86::Inst::kIdMov, to, from);
}

x86::Gp Writer::loaded(std::uint16_t index, const x86::Gp& scratch) {
  if (homes_[index])
    return *homes_[index];
  load(scratch, index);
  return scratch;
}

x86::Gp Writer::apart(std::uint16_t index, std::uint16_t other) const {
  return index == other ? x86::Gp(x86::eax) : place_of(index);
}

void Writer::store(std::uint16_t index, const x86::Gp& from) {
  if (!homes_[index])
    a_.mov(memory(index), from);
  else if (*homes_[index] != from)
    a_.mov(*homes_[index], from);
}

} // namespace orb::vm::native
#endif
