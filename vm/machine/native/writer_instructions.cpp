#if defined(ORB_NATIVE)
#include "vm/machine/native/writer.h"

#include "bytecode/arithmetic.h"

#include <bit>

namespace orb::vm::native {

void Writer::copy(std::uint16_t to, std::uint16_t from) {
  if (homes_[to])
    load(*homes_[to], from);
  else
    set(memory(to), from);
}

void Writer::set(const x86::Mem& to, std::uint16_t from) {
  if (is_constant(from))
    a_.mov(to, constant(from));
  else
    a_.mov(to, loaded(from, x86::edx));
}

void Writer::calculate(InstId op, std::uint16_t to, std::uint16_t left, std::uint16_t right) {
  const bool commutes = op != x86::Inst::kIdSub;
  if (to == right && to != left && commutes)
    std::swap(left, right);
  const x86::Gp place = to == right && to != left ? x86::Gp(x86::eax) : place_of(to);
  load(place, left);
  a_.emit(op, place, operand(right));
  store(to, place);
}

void Writer::multiply(const Instruction& i, std::optional<std::uint16_t> summand) {
  const auto place = summand ? apart(i.a, *summand) : place_of(i.a);
  const bool swaps = is_constant(i.b) || operand(i.c) == place;
  const auto [left, right] = swaps ? std::pair(i.c, i.b) : std::pair(i.b, i.c);
  const auto by = is_constant(right) ? constant(right) : 0;
  if (by == 3 || by == 5 || by == 9) {
    const auto x = loaded(left, x86::edx).r64();
    a_.lea(place, x86::ptr(x, x,
                           static_cast<std::uint32_t>(
                               std::countr_zero(static_cast<std::uint32_t>(by - 1)))));
  } else if (is_constant(right)) {
    a_.emit(x86::Inst::kIdImul, place, operand(left), Imm(constant(right)));
  } else {
    load(place, left);
    a_.emit(x86::Inst::kIdImul, place, operand(right));
  }
  if (summand)
    a_.emit(x86::Inst::kIdAdd, place, operand(*summand));
  store(i.a, place);
}

void Writer::divide(const Instruction& i, const x86::Gp& result) {
  load(x86::ecx, i.c);
  a_.lea(x86::edx, x86::ptr(x86::rcx, 1));
  a_.cmp(x86::edx, 1);
  a_.jbe(leave_);
  load(x86::eax, i.b);
  a_.cdq();
  a_.idiv(x86::ecx);
  store(i.a, result);
}

x86::Gp Writer::quotient(const Instruction& i) {
  const auto x = loaded(i.b, x86::ecx);
  a_.movsxd(x86::rax, x);
  reciprocals_.emplace_back(a_.newLabel(), bytecode::reciprocal(constant(i.c)));
  a_.imul(x86::qword_ptr(reciprocals_.back().first));
  a_.bt(x, 31);
  a_.adc(x86::edx, 0);
  return x;
}

void Writer::divide_by(const Instruction& i) {
  quotient(i);
  store(i.a, x86::edx);
}

void Writer::divide_subtract(const Instruction& i) {
  quotient(i);
  const auto place = place_of(i.a);
  load(place, i.d);
  a_.sub(place, x86::edx);
  store(i.a, place);
}

void Writer::remainder_by(const Instruction& i, std::optional<std::uint16_t> summand) {
  const auto x = quotient(i);
  const auto place = summand ? apart(i.a, *summand) : place_of(i.a);
  a_.imul(x86::edx, x86::edx, constant(i.c));
  if (place != x)
    a_.mov(place, x);
  a_.sub(place, x86::edx);
  if (summand)
    a_.emit(x86::Inst::kIdAdd, place, operand(*summand));
  store(i.a, place);
}

x86::Gp Writer::before_cut(const Instruction& i, const x86::Gp& to) {
  const auto x = loaded(i.b, x86::ecx);
  a_.mov(to, x);
  if (i.d > 1)
    a_.sar(to, 31);
  a_.shr(to, 32 - i.d);
  a_.add(to, x);
  return x;
}

void Writer::divide_by_power(const Instruction& i) {
  const auto to = apart(i.a, i.b);
  before_cut(i, to);
  a_.sar(to, i.d);
  store(i.a, to);
}

void Writer::remainder_by_power(const Instruction& i) {
  const auto x = before_cut(i, x86::eax);
  a_.and_(x86::eax, -constant(i.c));
  a_.mov(x86::edx, x);
  a_.sub(x86::edx, x86::eax);
  store(i.a, x86::edx);
}

void Writer::shift(InstId op, const Instruction& i) {
  const bool known = is_constant(i.c) && bytecode::is_shift_count(constant(i.c));
  const auto place = known ? place_of(i.a) : x86::Gp(x86::eax);
  if (!known) {
    load(x86::ecx, i.c);
    a_.cmp(x86::ecx, spec::value_of(spec::Limit::GreatestShift));
    a_.ja(leave_);
  }
  load(place, i.b);
  a_.emit(op, place, known ? operand(i.c) : Operand(x86::cl));
  store(i.a, place);
}

void Writer::absolute(const Instruction& i) {
  load(x86::eax, i.b);
  a_.mov(x86::ecx, x86::eax);
  a_.neg(x86::ecx);
  a_.cmovns(x86::eax, x86::ecx);
  store(i.a, x86::eax);
}

x86::Mem Writer::element() {
  const auto y = loaded(bytecode::index_variable, x86::eax);
  a_.lea(x86::eax, x86::ptr(y.r64(), -1));
  a_.cmp(x86::eax, bytecode::element_count);
  a_.jae(leave_);
  return x86::dword_ptr(r, x86::rax, 2, 4 * bytecode::first_element);
}

void Writer::load_element(const Instruction& i) {
  const auto from = element();
  const auto place = place_of(i.a);
  a_.mov(place, from);
  store(i.a, place);
}

void Writer::compare(std::uint16_t left, std::uint16_t right) {
  a_.emit(x86::Inst::kIdCmp, loaded(left, x86::eax), operand(right));
}

void Writer::test(const Instruction& i, x86::CondCode jumps) {
  compare(i.a, i.b);
  a_.j(jumps, way_to(i.target));
}

void Writer::select(std::uint32_t at, const Instruction& i, x86::CondCode takes_first) {
  const auto place = apart(i.a, i.d) == x86::eax ? x86::Gp(x86::ecx) : *homes_[i.a];
  if (i.op == Op::SelectClear)
    a_.emit(x86::Inst::kIdTest, loaded(i.b, x86::eax),
            is_constant(i.c) ? operand(i.c) : Operand(loaded(i.c, x86::ecx)));
  else
    compare(i.b, i.c);
  load(place, static_cast<std::uint16_t>(i.d + 1)); // mov leaves the flags alone
  a_.emit(x86::Inst::cmovccFromCond(takes_first), place, operand(i.d));
  store(i.a, place);
  jump(at, following_);
}

void Writer::jump(std::uint32_t at, std::uint32_t target) {
  if (target != at + 1)
    a_.jmp(way_to(target));
}

const Label& Writer::way_to(std::uint32_t target) const {
  return target == following_ ? ins_[step_ + 1] : labels_[target];
}

void Writer::begin_loop(std::uint32_t at, const Instruction& i) {
  const auto again = a_.newLabel();
  load(x86::edx, i.d == i.a ? i.b : i.d); // the loop variable is assigned first
  a_.test(x86::edx, x86::edx);
  a_.jz(leave_);
  a_.mov(x86::rcx, loop_at);
  a_.cmp(x86::dword_ptr(x86::rcx, offsetof(Loop, variable)), i.a);
  a_.je(again);
  a_.mov(x86::rdx, frames_at);
  a_.add(x86::rdx, offsetof(Frames, loops) + sizeof(Loop) * Frames::for_depth);
  a_.cmp(x86::rcx, x86::rdx);
  a_.je(leave_);
  a_.add(x86::rcx, sizeof(Loop));
  a_.mov(loop_at, x86::rcx);
  a_.bind(again);
  copy(i.a, i.b);
  a_.mov(x86::dword_ptr(x86::rcx, offsetof(Loop, body)), following_);
  set(x86::dword_ptr(x86::rcx, offsetof(Loop, end)), i.c);
  set(x86::dword_ptr(x86::rcx, offsetof(Loop, step)), i.d);
  a_.mov(x86::dword_ptr(x86::rcx, offsetof(Loop, variable)), i.a);
  jump(at, following_);
}

void Writer::end_loop(std::uint32_t at, const Instruction& i) {
  const auto head = plan_.head_of(at);
  const auto end = chunk_.code[head].c;
  const std::int32_t step = constant(chunk_.code[head].d);
  a_.mov(x86::rax, loop_at);
  a_.cmp(x86::dword_ptr(x86::rax, offsetof(Loop, body)), head + 1);
  a_.jne(leave_);
  a_.emit(x86::Inst::kIdAdd, operand(i.a), Imm(step));
  if (!is_constant(end))
    a_.mov(x86::edx, x86::dword_ptr(x86::rax, offsetof(Loop, end)));
  a_.emit(x86::Inst::kIdCmp, operand(i.a), is_constant(end) ? operand(end) : Operand(x86::edx));
  a_.j(step > 0 ? x86::CondCode::kLE : x86::CondCode::kGE, labels_[head + 1]);
  a_.sub(loop_at, sizeof(Loop));
  jump(at, following_);
}

void Writer::load_calls() {
  a_.mov(x86::rcx, frames_at);
  a_.mov(x86::eax, x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)));
}

void Writer::open_calls(const std::vector<std::uint32_t>& places) {
  for (const auto place : places) {
    a_.mov(x86::dword_ptr(x86::rcx, x86::rax, 2, offsetof(Frames, calls)), place);
    a_.add(x86::eax, 1);
  }
  a_.mov(x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)), x86::eax);
}

void Writer::call(std::uint32_t at, const Instruction& i) {
  load_calls();
  a_.cmp(x86::eax, Frames::gosub_depth - plan_.steps()[step_].calls.size());
  a_.jae(leave_);
  if (plan_.is_called(step_ + 1))
    return;
  open_calls({following_});
  jump(at, i.target);
}

void Writer::come_back() {
  if (plan_.is_called(step_))
    return;
  load_calls();
  a_.sub(x86::eax, 1);
  a_.jc(leave_);
  a_.mov(x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)), x86::eax);
  a_.mov(x86::eax, x86::dword_ptr(x86::rcx, x86::rax, 2, offsetof(Frames, calls)));
  a_.lea(x86::rdx, x86::ptr(table_));
  a_.jmp(x86::qword_ptr(x86::rdx, x86::rax, 3));
}

} // namespace orb::vm::native
#endif
