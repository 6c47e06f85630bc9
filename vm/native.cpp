#include "vm/native.h"

#include "bytecode/arithmetic.h"
#include "vm/machine_core.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#if defined(ORB_NATIVE)
#include <asmjit/x86.h>
#endif

namespace orb::vm {

namespace {

using bytecode::Chunk;
using bytecode::Instruction;
using bytecode::Op;

constexpr std::size_t most_kept = 64;

} // namespace

const NativeCode* NativePrograms::find(const Chunk& chunk) {
  const std::lock_guard lock(mutex_);
  for (const auto& kept : kept_)
    if (kept.chunk == chunk)
      return kept.code.get();
  if (kept_.size() == most_kept)
    return nullptr;
  kept_.push_back({chunk, NativeCode::compile(chunk)});
  return kept_.back().code.get();
}

#if defined(ORB_NATIVE)

namespace {

namespace x86 = asmjit::x86;
using asmjit::Imm;
using asmjit::Label;
using asmjit::Operand;
using InstId = asmjit::InstId;

// Where things are while machine code runs. The most used registers of the program live in those
// of the processor; the others, and all of them outside, in memory at `r`.
const x86::Gp r = x86::rbx;
const x86::Gp budget = x86::rbp;
const std::array homes{x86::esi,  x86::edi,  x86::r8d,  x86::r9d,  x86::r10d,
                       x86::r11d, x86::r12d, x86::r13d, x86::r14d, x86::r15d};
const std::array saved{x86::rbx, x86::rbp, x86::r12, x86::r13, x86::r14, x86::r15};
const x86::Mem frames_at = x86::qword_ptr(x86::rsp);
const x86::Mem budget_at = x86::qword_ptr(x86::rsp, 8);
constexpr int stack_bytes = 16;

using Entry = std::uint32_t (*)(std::int32_t* registers, Frames* frames, std::int64_t* budget,
                                const void* line);

constexpr std::size_t most_instructions = 65536;
constexpr std::uint32_t none = 0xFFFFFFFF;

/// Whether machine code of an operation may turn to the loop, which then does the whole line.
enum class Leaves : std::uint8_t { Never, Rarely, Always };

Leaves leaves(Op op) {
  using enum Op;
  constexpr std::array never{
      Copy,        Add,          Subtract,      Multiply,      DivideBy,   RemainderBy,
      And,         Or,           Abs,           UnlessEqual,   UnlessLess, UnlessNotEqual,
      WhenEqual,   WhenNotEqual, WhenLess,      WhenGreater,   Goto,       UnlessGreater,
      SelectEqual, SelectLess,   SelectGreater, SelectNotEqual};
  constexpr std::array rarely{Divide, Remainder,    ShiftLeft, ShiftRight, Sqrt,  LoadElement,
                              For,    StoreElement, Next,      Gosub,      Return};
  if (std::find(never.begin(), never.end(), op) != never.end())
    return Leaves::Never;
  return std::find(rarely.begin(), rarely.end(), op) != rarely.end() ? Leaves::Rarely
                                                                     : Leaves::Always;
}

/// What is decided about a program before its code is written.
class Plan {
public:
  explicit Plan(const Chunk& chunk) : chunk_(chunk), loop_of_(chunk.code.size(), none) {
    match_loops();
    for (std::size_t line = 0; line < chunk.lines.size(); ++line)
      is_native_.push_back(stays_in_machine_code(line));
    choose_homes();
  }

  std::uint32_t begin(std::size_t line) const {
    return line < chunk_.lines.size() ? chunk_.lines[line].begin
                                      : static_cast<std::uint32_t>(chunk_.code.size() - 1);
  }
  /// Where the line behind that of an instruction begins.
  std::uint32_t line_after(std::uint32_t at) const {
    const auto after =
        std::upper_bound(chunk_.lines.begin(), chunk_.lines.end(), at,
                         [](std::uint32_t place, const auto& line) { return place < line.begin; });
    return begin(static_cast<std::size_t>(after - chunk_.lines.begin()));
  }
  bool is_native(std::size_t line) const { return is_native_[line]; }
  /// The `for` whose loop a `next` steps unless the program jumps about, or none.
  std::uint32_t loop_of(std::uint32_t next) const { return loop_of_[next]; }
  /// The registers that live in those of the processor, one for each of `homes`.
  std::span<const std::uint16_t> housed() const { return housed_; }
  bool is_written(std::uint16_t index) const { return is_written_[index]; }

private:
  /// A `next` belongs to the last `for` of its variable above it. Only a loop whose first line is
  /// nobody else's can be told by that line.
  void match_loops() {
    std::vector<std::uint8_t> begun(chunk_.code.size());
    std::vector<std::uint32_t> last(bytecode::first_temporary, none);
    for (std::size_t line = 0; line < chunk_.lines.size(); ++line)
      for (std::uint32_t at = begin(line); at < begin(line + 1); ++at) {
        const auto& instruction = chunk_.code[at];
        if (instruction.op == Op::For || instruction.op == Op::ForElement)
          begun[begin(line + 1)] = static_cast<std::uint8_t>(begun[begin(line + 1)] + 1);
      }
    for (std::size_t line = 0; line < chunk_.lines.size(); ++line)
      for (std::uint32_t at = begin(line); at < begin(line + 1); ++at) {
        const auto& instruction = chunk_.code[at];
        if (instruction.a >= last.size())
          continue;
        if (instruction.op == Op::For)
          last[instruction.a] = begun[begin(line + 1)] == 1 ? at : none;
        else if (instruction.op == Op::Next)
          loop_of_[at] = last[instruction.a];
      }
  }

  /// A line that turns to the loop is done again from its beginning, so nothing may have happened.
  bool stays_in_machine_code(std::size_t line) const {
    bool changed = false;
    for (std::uint32_t at = begin(line); at < begin(line + 1); ++at) {
      const auto& instruction = chunk_.code[at];
      const auto& row = bytecode::info(instruction.op);
      const auto leaving = leaves(instruction.op);
      if (leaving == Leaves::Always || (leaving == Leaves::Rarely && changed) ||
          (instruction.op == Op::Next && loop_of_[at] == none))
        return false;
      changed = changed || instruction.op == Op::StoreElement ||
                (row.operands[0] == 'w' && instruction.a < bytecode::first_temporary);
      if (instruction.ends_line || row.ends == bytecode::Ends::Line || instruction.op == Op::Goto)
        changed = false; // what stands behind is reached from a test
    }
    return true;
  }

  /// The registers that are used most, by a guess: inside a loop eight times as often as outside.
  void choose_homes() {
    const std::size_t size = chunk_.code.size();
    std::vector<int> deeper(size + 1);
    for (std::uint32_t at = 0; at < size; ++at) {
      const auto& instruction = chunk_.code[at];
      const std::uint32_t back = loop_of_[at] != none                          ? loop_of_[at]
                                 : bytecode::info(instruction.op).has_target() ? instruction.target
                                                                               : none;
      if (back <= at) {
        ++deeper[back];
        --deeper[at + 1];
      }
    }
    std::vector<std::uint64_t> uses(chunk_.first_constant() + std::size_t{1});
    is_written_.resize(uses.size());
    int depth = 0;
    for (std::uint32_t at = 0; at < size; ++at) {
      depth += deeper[at];
      const auto& instruction = chunk_.code[at];
      const auto operands = bytecode::info(instruction.op).operands;
      const std::uint64_t weight = std::uint64_t{1} << 3 * std::clamp(depth, 0, 6);
      const std::array values{instruction.a, instruction.b, instruction.c, instruction.d};
      if (leaves(instruction.op) == Leaves::Always)
        continue;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const bool is_register = operands[i] == 'r' || operands[i] == 'w' || operands[i] == 'p';
        if (is_register && values[i] < chunk_.first_constant())
          uses[values[i]] += weight;
        if (operands[i] == 'p')
          uses[values[i] + 1u] += weight;
        if (operands[i] == 'w')
          is_written_[values[i]] = true;
      }
      if (instruction.op == Op::LoadElement || instruction.op == Op::StoreElement)
        uses[bytecode::index_variable] += weight;
    }
    for (std::uint16_t index = 0; index < chunk_.first_constant(); ++index)
      if (uses[index] > 0)
        housed_.push_back(index);
    std::stable_sort(housed_.begin(), housed_.end(),
                     [&](auto x, auto y) { return uses[x] > uses[y]; });
    housed_.resize(std::min(housed_.size(), homes.size()));
  }

  const Chunk& chunk_;
  std::vector<std::uint32_t> loop_of_;
  std::vector<bool> is_native_;
  std::vector<std::uint16_t> housed_;
  std::vector<bool> is_written_;
};

/// Division by a constant: the high part of a product, as bytecode::divide_by() has it, with the
/// smallest factor that is exact for 32 bits.
struct Factor {
  std::uint32_t factor = 0;
  int shift = 0;
};

Factor factor_of(std::uint32_t divisor) {
  for (int shift = 32;; ++shift) {
    const std::uint64_t power = std::uint64_t{1} << shift;
    const std::uint64_t factor = power / divisor + 1;
    if ((factor * divisor - power) << 31 < power)
      return {static_cast<std::uint32_t>(factor), shift};
  }
}

/// Writes the code of a program.
class Writer {
public:
  Writer(const Chunk& chunk, const Plan& plan, x86::Assembler& assembler)
      : chunk_(chunk), plan_(plan), a_(assembler), homes_(chunk.register_count()) {
    for (std::size_t i = 0; i < chunk.code.size(); ++i)
      labels_.push_back(a_.newLabel());
    for (std::size_t i = 0; i < plan.housed().size(); ++i)
      homes_[plan.housed()[i]] = homes[i];
    exit_ = a_.newLabel();
    exit_uncounted_ = a_.newLabel();
    table_ = a_.newLabel();
  }

  /// Returns for each line, and for what stands behind them, how long `log` was before it.
  std::vector<std::size_t> program(const asmjit::StringLogger& log) {
    std::vector<std::size_t> logged;
    enter();
    for (std::size_t line = 0; line < chunk_.lines.size(); ++line) {
      logged.push_back(log.dataSize());
      write_line(line);
    }
    logged.push_back(log.dataSize());
    const auto end = plan_.begin(chunk_.lines.size());
    a_.bind(labels_[end]);
    a_.mov(x86::eax, end);
    a_.jmp(exit_);
    for (const auto& [label, begin] : leaves_) {
      a_.bind(label);
      a_.mov(x86::eax, begin);
      a_.jmp(exit_uncounted_);
    }
    leave();
    write_table();
    return logged;
  }

  const Label& table() const { return table_; }

private:
  // Entry and exit.

  void enter() {
    for (const auto& one : saved)
      a_.push(one);
    a_.sub(x86::rsp, stack_bytes);
    a_.mov(frames_at, x86::rsi);
    a_.mov(budget_at, x86::rdx);
    a_.mov(r, x86::rdi);
    a_.mov(budget, x86::qword_ptr(x86::rdx));
    for (const auto index : plan_.housed())
      if (index < bytecode::first_temporary)
        a_.mov(*homes_[index], memory(index));
    a_.jmp(x86::rcx);
  }

  void leave() {
    a_.bind(exit_uncounted_); // the line has counted down, and does not run here
    a_.add(budget, 1);
    a_.bind(exit_);
    for (const auto index : plan_.housed())
      if (index < bytecode::first_temporary && plan_.is_written(index))
        a_.mov(memory(index), *homes_[index]);
    a_.mov(x86::rcx, budget_at);
    a_.mov(x86::qword_ptr(x86::rcx), budget);
    a_.add(x86::rsp, stack_bytes);
    for (auto one = saved.rbegin(); one != saved.rend(); ++one)
      a_.pop(*one);
    a_.ret();
  }

  /// Where the line of an instruction begins, from the table on.
  void write_table() {
    a_.align(asmjit::AlignMode::kData, 4);
    a_.bind(table_);
    std::vector<bool> begins(chunk_.code.size());
    for (std::size_t line = 0; line <= chunk_.lines.size(); ++line)
      begins[plan_.begin(line)] = true;
    for (std::size_t at = 0; at < chunk_.code.size(); ++at) {
      if (begins[at])
        a_.embedLabelDelta(labels_[at], table_, 4);
      else
        a_.embedUInt32(0);
    }
  }

  // Lines.

  void write_line(std::size_t line) {
    const auto begin = plan_.begin(line);
    a_.bind(labels_[begin]);
    if (!plan_.is_native(line)) {
      a_.mov(x86::eax, begin);
      a_.jmp(exit_);
      return;
    }
    leave_ = a_.newLabel();
    leaves_.push_back({leave_, begin});
    following_ = plan_.begin(line + 1);
    a_.sub(budget, 1);
    a_.jc(leave_);
    for (std::uint32_t at = begin; at < following_; ++at) {
      if (at != begin)
        a_.bind(labels_[at]);
      write(at, chunk_.code[at]);
    }
  }

  void write(std::uint32_t at, const Instruction& i) {
    switch (i.op) {
    case Op::Copy: copy(i.a, i.b); break;
    case Op::Add: add(i); break;
    case Op::Subtract: calculate(x86::Inst::kIdSub, i.a, i.b, i.c); break;
    case Op::Multiply: multiply(i); break;
    case Op::And: calculate(x86::Inst::kIdAnd, i.a, i.b, i.c); break;
    case Op::Or: calculate(x86::Inst::kIdOr, i.a, i.b, i.c); break;
    case Op::Divide: divide(i, x86::eax); break;
    case Op::Remainder: divide(i, x86::edx); break;
    case Op::DivideBy: divide_by(i); break;
    case Op::RemainderBy: remainder_by(i); break;
    case Op::ShiftLeft: shift(x86::Inst::kIdShl, i); break;
    case Op::ShiftRight: shift(x86::Inst::kIdSar, i); break;
    case Op::Abs: absolute(i); break;
    case Op::Sqrt: square_root(i); break;
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
    case Op::Goto: jump(at, i.target); break;
    case Op::For: begin_loop(at, i); break;
    case Op::Next: end_loop(at, i); break;
    case Op::Gosub: call(at, i); break;
    case Op::Return: come_back(); break;
    case Op::Rnd:
    case Op::ReadSystem:
    case Op::WriteSystem:
    case Op::ReadData:
    case Op::OnGoto:
    case Op::OnGosub:
    case Op::Target:
    case Op::ForElement:
    case Op::NextElement:
    case Op::End:
    case Op::EndOfProgram:
    case Op::Trap:
    case Op::PrintText:
    case Op::PrintNumber:
    case Op::PrintCharacter:
    case Op::PrintBlank:
    case Op::PrintLine:
    case Op::PrintOpen:
    case Op::Delay:
    case Op::Input:
    case Op::InputTimed:
    case Op::SetData:
    case Op::RestartData:
    case Op::Perform:
    case Op::Random:
    case Op::Tron:
    case Op::Troff:
    case Op::Reset: break; // of lines that are left to the loop
    }
  }

  // Operands. eax, ecx and edx are free within an instruction.

  bool is_constant(std::uint16_t index) const { return index >= chunk_.first_constant(); }
  std::int32_t constant(std::uint16_t index) const {
    return chunk_.constants[index - chunk_.first_constant()];
  }
  static x86::Mem memory(std::uint16_t index) { return x86::dword_ptr(r, 4 * index); }

  Operand operand(std::uint16_t index) const {
    if (is_constant(index))
      return Imm(constant(index));
    return homes_[index] ? Operand(*homes_[index]) : Operand(memory(index));
  }

  void load(const x86::Gp& to, std::uint16_t index) {
    if (const auto from = operand(index); from != to)
      a_.emit(x86::Inst::kIdMov, to, from);
  }

  /// The value in a register of the processor: its own, or `scratch`.
  x86::Gp loaded(std::uint16_t index, const x86::Gp& scratch) {
    if (homes_[index])
      return *homes_[index];
    load(scratch, index);
    return scratch;
  }

  /// Where a result is computed: in its home, or in eax.
  x86::Gp place_of(std::uint16_t index) const { return homes_[index].value_or(x86::eax); }

  void store(std::uint16_t index, const x86::Gp& from) {
    if (!homes_[index])
      a_.mov(memory(index), from);
    else if (*homes_[index] != from)
      a_.mov(*homes_[index], from);
  }

  // Values.

  void copy(std::uint16_t to, std::uint16_t from) {
    if (homes_[to])
      load(*homes_[to], from);
    else
      set(memory(to), from);
  }

  void set(const x86::Mem& to, std::uint16_t from) {
    if (is_constant(from))
      a_.mov(to, constant(from));
    else
      a_.mov(to, loaded(from, x86::edx));
  }

  void calculate(InstId op, std::uint16_t to, std::uint16_t left, std::uint16_t right) {
    const bool commutes = op != x86::Inst::kIdSub;
    if (to == right && to != left && commutes)
      std::swap(left, right);
    const x86::Gp place = to == right && to != left ? x86::Gp(x86::eax) : place_of(to);
    load(place, left);
    a_.emit(op, place, operand(right));
    store(to, place);
  }

  /// Of three registers, or two and a number, as an address.
  void add(const Instruction& i) {
    const auto left = homes_[i.b];
    const auto to = homes_[i.a];
    if (left && to && left != to && is_constant(i.c))
      a_.lea(*to, x86::ptr(left->r64(), constant(i.c)));
    else if (left && to && left != to && homes_[i.c] && homes_[i.c] != to)
      a_.lea(*to, x86::ptr(left->r64(), homes_[i.c]->r64()));
    else
      calculate(x86::Inst::kIdAdd, i.a, i.b, i.c);
  }

  void multiply(const Instruction& i) {
    const auto [value, number] = is_constant(i.b) ? std::pair(i.c, i.b) : std::pair(i.b, i.c);
    if (!is_constant(number) || is_constant(value)) {
      calculate(x86::Inst::kIdImul, i.a, i.b, i.c);
      return;
    }
    const auto place = place_of(i.a);
    a_.emit(x86::Inst::kIdImul, place, operand(value), Imm(constant(number)));
    store(i.a, place);
  }

  /// The loop divides by 0 and by -1, whose quotient may not fit.
  void divide(const Instruction& i, const x86::Gp& result) {
    load(x86::ecx, i.c);
    a_.lea(x86::edx, x86::ptr(x86::rcx, 1));
    a_.cmp(x86::edx, 1);
    a_.jbe(leave_);
    load(x86::eax, i.b);
    a_.cdq();
    a_.idiv(x86::ecx);
    store(i.a, result);
  }

  /// Leaves the quotient in eax and b in what is returned; rounds toward zero.
  x86::Gp quotient(const Instruction& i) {
    const auto x = loaded(i.b, x86::ecx);
    const auto divisor = static_cast<std::uint32_t>(constant(i.c));
    const auto [factor, bits] = factor_of(divisor);
    a_.movsxd(x86::rax, x);
    if (factor <= 0x7FFFFFFF) {
      a_.imul(x86::rax, x86::rax, factor);
    } else {
      a_.mov(x86::edx, factor);
      a_.imul(x86::rax, x86::rdx);
    }
    a_.sar(x86::rax, bits);
    a_.mov(x86::edx, x);
    a_.shr(x86::edx, 31);
    a_.add(x86::eax, x86::edx);
    return x;
  }

  /// Of a divisor 2^bits: leaves b, moved toward the next multiple by what rounding toward zero
  /// needs, in eax, and b in what is returned.
  x86::Gp toward_zero(const Instruction& i, int bits) {
    const auto x = loaded(i.b, x86::ecx);
    a_.mov(x86::eax, x);
    if (bits > 1)
      a_.sar(x86::eax, 31);
    a_.shr(x86::eax, 32 - bits);
    a_.add(x86::eax, x);
    return x;
  }

  void divide_by(const Instruction& i) {
    const auto divisor = static_cast<std::uint32_t>(constant(i.c));
    if (std::has_single_bit(divisor)) {
      toward_zero(i, std::countr_zero(divisor));
      a_.sar(x86::eax, std::countr_zero(divisor));
    } else {
      quotient(i);
    }
    store(i.a, x86::eax);
  }

  void remainder_by(const Instruction& i) {
    const auto divisor = static_cast<std::uint32_t>(constant(i.c));
    if (std::has_single_bit(divisor)) {
      const auto x = toward_zero(i, std::countr_zero(divisor));
      a_.and_(x86::eax, -constant(i.c));
      a_.mov(x86::edx, x);
      a_.sub(x86::edx, x86::eax);
      store(i.a, x86::edx);
    } else {
      const auto x = quotient(i);
      a_.imul(x86::edx, x86::eax, constant(i.c));
      a_.mov(x86::eax, x);
      a_.sub(x86::eax, x86::edx);
      store(i.a, x86::eax);
    }
  }

  void shift(InstId op, const Instruction& i) {
    if (!is_constant(i.c)) {
      load(x86::ecx, i.c);
      a_.cmp(x86::ecx, spec::value_of(spec::Limit::GreatestShift));
      a_.ja(leave_);
      load(x86::eax, i.b);
      a_.emit(op, x86::eax, x86::cl);
      store(i.a, x86::eax);
    } else if (bytecode::is_shift_count(constant(i.c))) {
      const auto place = place_of(i.a);
      load(place, i.b);
      a_.emit(op, place, Imm(constant(i.c)));
      store(i.a, place);
    } else {
      a_.jmp(leave_);
    }
  }

  void absolute(const Instruction& i) {
    load(x86::eax, i.b);
    a_.mov(x86::ecx, x86::eax);
    a_.neg(x86::ecx);
    a_.cmovns(x86::eax, x86::ecx);
    store(i.a, x86::eax);
  }

  void square_root(const Instruction& i) {
    load(x86::eax, i.b);
    a_.test(x86::eax, x86::eax);
    a_.js(leave_);
    a_.cvtsi2sd(x86::xmm0, x86::eax);
    a_.sqrtsd(x86::xmm0, x86::xmm0);
    a_.cvttsd2si(x86::eax, x86::xmm0);
    store(i.a, x86::eax);
  }

  /// The element of Z that Y names; spoils eax.
  x86::Mem element() {
    const auto y = loaded(bytecode::index_variable, x86::eax);
    a_.lea(x86::eax, x86::ptr(y.r64(), -1));
    a_.cmp(x86::eax, bytecode::element_count);
    a_.jae(leave_);
    return x86::dword_ptr(r, x86::rax, 2, 4 * bytecode::first_element);
  }

  void load_element(const Instruction& i) {
    const auto from = element();
    const auto place = place_of(i.a);
    a_.mov(place, from);
    store(i.a, place);
  }

  void store_element(const Instruction& i) { set(element(), i.a); }

  // Decisions.

  void compare(std::uint16_t left, std::uint16_t right) {
    if (homes_[left] && is_constant(right) && constant(right) == 0) {
      a_.test(*homes_[left], *homes_[left]);
      return;
    }
    const bool direct =
        homes_[left] || (!is_constant(left) && (is_constant(right) || homes_[right]));
    if (!direct)
      load(x86::eax, left);
    a_.emit(x86::Inst::kIdCmp, direct ? operand(left) : Operand(x86::eax), operand(right));
  }

  void test(const Instruction& i, x86::CondCode jumps) {
    compare(i.a, i.b);
    a_.j(jumps, labels_[i.target]);
  }

  void select(std::uint32_t at, const Instruction& i, x86::CondCode takes_first) {
    const auto second = static_cast<std::uint16_t>(i.d + 1);
    load(x86::ecx, second); // eax is what a comparison may need
    compare(i.b, i.c);
    a_.emit(x86::Inst::cmovccFromCond(takes_first), x86::ecx, operand(i.d));
    store(i.a, x86::ecx);
    jump(at, following_);
  }

  // Control.

  void jump(std::uint32_t at, std::uint32_t target) {
    if (target != at + 1)
      a_.jmp(labels_[target]);
  }

  /// Leaves the frames in rcx and the innermost loop in rax.
  void load_loop() {
    a_.mov(x86::rcx, frames_at);
    a_.mov(x86::rax, x86::qword_ptr(x86::rcx, offsetof(Frames, loop)));
  }

  void begin_loop(std::uint32_t at, const Instruction& i) {
    load(x86::edx, i.d == i.a ? i.b : i.d); // the start is assigned first
    a_.test(x86::edx, x86::edx);
    a_.jz(leave_);
    const auto again = a_.newLabel();
    load_loop();
    a_.cmp(x86::dword_ptr(x86::rax, offsetof(Loop, variable)), i.a);
    a_.je(again);
    a_.lea(x86::rdx,
           x86::ptr(x86::rcx, offsetof(Frames, loops) + sizeof(Loop) * Frames::for_depth));
    a_.cmp(x86::rax, x86::rdx);
    a_.je(leave_);
    a_.add(x86::rax, sizeof(Loop));
    a_.mov(x86::qword_ptr(x86::rcx, offsetof(Frames, loop)), x86::rax);
    a_.bind(again);
    a_.mov(x86::rcx, x86::rax);
    copy(i.a, i.b);
    a_.mov(x86::dword_ptr(x86::rcx, offsetof(Loop, body)), following_);
    set(x86::dword_ptr(x86::rcx, offsetof(Loop, end)), i.c);
    set(x86::dword_ptr(x86::rcx, offsetof(Loop, step)), i.d);
    a_.mov(x86::dword_ptr(x86::rcx, offsetof(Loop, variable)), i.a);
    jump(at, following_);
  }

  /// The loop that runs is most probably that of the `for` above: its first line tells.
  void end_loop(std::uint32_t at, const Instruction& i) {
    const auto& loop = chunk_.code[plan_.loop_of(at)];
    const auto first = plan_.line_after(plan_.loop_of(at));
    const auto& body = labels_[first];
    load_loop();
    a_.cmp(x86::dword_ptr(x86::rax, offsetof(Loop, body)), first);
    a_.jne(leave_);
    if (is_constant(loop.d)) {
      const auto value = step(i.a, Imm(constant(loop.d)));
      compare_with_end(value, loop);
      a_.j(constant(loop.d) > 0 ? x86::CondCode::kLE : x86::CondCode::kGE, body);
    } else {
      const auto downward = a_.newLabel();
      const auto done = a_.newLabel();
      a_.mov(x86::edx, x86::dword_ptr(x86::rax, offsetof(Loop, step)));
      const auto value = step(i.a, x86::edx);
      a_.test(x86::edx, x86::edx);
      a_.js(downward);
      compare_with_end(value, loop);
      a_.jle(body);
      a_.jmp(done);
      a_.bind(downward);
      compare_with_end(value, loop);
      a_.jge(body);
      a_.bind(done);
    }
    a_.sub(x86::qword_ptr(x86::rcx, offsetof(Frames, loop)), sizeof(Loop));
    jump(at, following_);
  }

  Operand step(std::uint16_t variable, const Operand& by) {
    const auto value = operand(variable);
    a_.emit(x86::Inst::kIdAdd, value, by);
    return value;
  }

  void compare_with_end(const Operand& value, const Instruction& loop) {
    if (is_constant(loop.c)) {
      a_.emit(x86::Inst::kIdCmp, value, Imm(constant(loop.c)));
      return;
    }
    a_.mov(x86::edx, x86::dword_ptr(x86::rax, offsetof(Loop, end)));
    a_.emit(x86::Inst::kIdCmp, value, x86::edx);
  }

  void call(std::uint32_t at, const Instruction& i) {
    a_.mov(x86::rcx, frames_at);
    a_.mov(x86::eax, x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)));
    a_.cmp(x86::eax, Frames::gosub_depth);
    a_.je(leave_);
    a_.mov(x86::dword_ptr(x86::rcx, x86::rax, 2, offsetof(Frames, calls)), following_);
    a_.add(x86::eax, 1);
    a_.mov(x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)), x86::eax);
    jump(at, i.target);
  }

  void come_back() {
    a_.mov(x86::rcx, frames_at);
    a_.mov(x86::eax, x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)));
    a_.sub(x86::eax, 1);
    a_.jc(leave_);
    a_.mov(x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)), x86::eax);
    a_.mov(x86::eax, x86::dword_ptr(x86::rcx, x86::rax, 2, offsetof(Frames, calls)));
    a_.lea(x86::rdx, x86::ptr(table_));
    a_.movsxd(x86::rax, x86::dword_ptr(x86::rdx, x86::rax, 2));
    a_.add(x86::rax, x86::rdx);
    a_.jmp(x86::rax);
  }

  const Chunk& chunk_;
  const Plan& plan_;
  x86::Assembler& a_;
  std::vector<std::optional<x86::Gp>> homes_;           ///< by register of the program
  std::vector<Label> labels_;                           ///< by instruction
  std::vector<std::pair<Label, std::uint32_t>> leaves_; ///< with the line that the loop shall do
  Label exit_;
  Label exit_uncounted_;
  Label table_;
  // Of the line that is being written.
  Label leave_;
  std::uint32_t following_ = 0;
};

/// Remembers that something could not be written, as Writer does not ask each time.
class Failure final : public asmjit::ErrorHandler {
public:
  void handleError(asmjit::Error, const char*, asmjit::BaseEmitter*) override { happened = true; }
  bool happened = false;
};

/// The finished code of a program, not yet in memory of its own.
struct Draft {
  explicit Draft(const Chunk& chunk, asmjit::StringLogger* log = nullptr) {
    code.init(asmjit::Environment::host());
    code.setErrorHandler(&failure);
    if (log)
      code.setLogger(log);
    x86::Assembler assembler(&code);
    const Plan plan(chunk);
    Writer writer(chunk, plan, assembler);
    const asmjit::StringLogger no_log;
    logged = writer.program(log ? *log : no_log);
    code.flatten();
    code.resolveUnresolvedLinks();
    table = static_cast<std::size_t>(code.labelOffset(writer.table()));
    is_good = !failure.happened && !code.hasUnresolvedLinks();
  }

  Failure failure;
  asmjit::CodeHolder code;
  std::vector<std::size_t> logged;
  std::size_t table = 0;
  bool is_good = false;
};

} // namespace

bool has_native_code() {
  return true;
}

std::unique_ptr<NativeCode> NativeCode::compile(const Chunk& chunk) {
  namespace memory = asmjit::VirtMem;
  if (chunk.code.size() > most_instructions)
    return nullptr;
  Draft draft(chunk);
  std::unique_ptr<NativeCode> made(new NativeCode);
  made->size_ = draft.code.codeSize();
  if (!draft.is_good ||
      memory::alloc(&made->memory_, made->size_, memory::MemoryFlags::kAccessRW) != 0)
    return nullptr;
  draft.code.relocateToBase(reinterpret_cast<std::uintptr_t>(made->memory_));
  draft.code.copyFlattenedData(made->memory_, made->size_);
  if (draft.failure.happened ||
      memory::protect(made->memory_, made->size_, memory::MemoryFlags::kAccessRX) != 0)
    return nullptr;
  made->table_ =
      reinterpret_cast<const std::int32_t*>(static_cast<char*>(made->memory_) + draft.table);
  return made;
}

NativeCode::~NativeCode() {
  if (memory_)
    asmjit::VirtMem::release(memory_, size_);
}

const char* NativeCode::address_of(std::uint32_t at) const {
  return reinterpret_cast<const char*>(table_) + table_[at];
}

void NativeCode::run(Core& core) const {
  const auto enter = reinterpret_cast<Entry>(memory_);
  const auto next =
      enter(core.registers.data(), &core.frames, &core.budget, address_of(core.index_of(core.pc)));
  core.pc = core.code.data() + next;
}

std::vector<NativeCode::Piece> NativeCode::pieces(const Chunk& chunk) const {
  std::vector<Piece> found;
  for (std::size_t i = 0; i < chunk.lines.size(); ++i) {
    const char* const begin = address_of(chunk.lines[i].begin);
    const char* const end =
        address_of(i + 1 < chunk.lines.size() ? chunk.lines[i + 1].begin
                                              : static_cast<std::uint32_t>(chunk.code.size() - 1));
    found.push_back({chunk.lines[i].number, begin, static_cast<std::size_t>(end - begin)});
  }
  return found;
}

std::string native_listing(const Chunk& chunk) {
  asmjit::StringLogger log;
  const Draft draft(chunk, &log);
  std::vector<std::string> behind;
  for (std::size_t i = 0; i + 1 < draft.logged.size(); ++i)
    behind.emplace_back(log.data() + draft.logged[i], draft.logged[i + 1] - draft.logged[i]);
  return bytecode::listing(chunk, behind);
}

#else

bool has_native_code() {
  return false;
}
std::unique_ptr<NativeCode> NativeCode::compile(const Chunk&) {
  return nullptr;
}
NativeCode::~NativeCode() = default;
void NativeCode::run(Core&) const {}
std::vector<NativeCode::Piece> NativeCode::pieces(const Chunk&) const {
  return {};
}
std::string native_listing(const Chunk& chunk) {
  return bytecode::listing(chunk);
}

#endif
} // namespace orb::vm
