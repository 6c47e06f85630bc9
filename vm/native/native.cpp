#include "vm/native/native.h"

#include "bytecode/arithmetic.h"
#include "vm/machine/core.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#if defined(ORB_NATIVE)
#include <asmjit/x86.h>
#endif

namespace orb::vm {

namespace {

using bytecode::Chunk;
using bytecode::Compiled;
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
  auto made = NativeCode::compile(chunk);
  kept_.push_back({chunk, made ? *std::move(made) : nullptr});
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
const x86::Mem loop_at = x86::qword_ptr(x86::rsp); ///< Frames::loop
const x86::Mem frames_at = x86::qword_ptr(x86::rsp, 8);

using Entry = std::uint32_t (*)(std::int32_t* registers, Frames* frames, std::int64_t* budget,
                                const void* line);

constexpr std::size_t most_instructions = 4096; // no area of the robot has as many characters
constexpr std::string_view too_large = "the program is too large for machine code";
constexpr std::uint32_t none = UINT32_MAX;

/// What is decided about a program before its code is written.
class Plan {
public:
  explicit Plan(const Chunk& chunk) : chunk_(chunk), heads_(chunk.code.size(), none) {
    match_loops();
    follow_ways();
    form_blocks();
    choose_homes();
  }

  /// A line where it is written: in its place or, of a short subroutine, behind a call of it.
  struct Step {
    std::size_t line = 0;
    std::vector<std::uint32_t> calls; ///< where the calls return to that led here
    /// How many lines of its block are left, with this one: they are counted together. 0 where the
    /// line is left to the loop.
    int rest = 0;
  };
  const std::vector<Step>& steps() const { return steps_; }
  bool begins_block(std::size_t step) const { return step == 0 || steps_[step - 1].rest <= 1; }
  bool is_called(std::size_t step) const { return !steps_[step].calls.empty(); }
  /// The `for` of the loop that a `next` steps, unless the program jumps about.
  std::uint32_t head_of(std::uint32_t next) const { return heads_[next]; }
  /// The registers that live in those of the processor, one for each of `homes`.
  std::span<const std::uint16_t> housed() const { return housed_; }

private:
  /// A `next` belongs to the last `for` of its variable above it. A loop is known by its first
  /// line, so that must be nobody else's, and by a step that is a number.
  void match_loops() {
    std::array<std::uint32_t, bytecode::first_temporary> last;
    last.fill(none);
    for (std::size_t i = 0; i < chunk_.lines.size(); ++i) {
      const bool tests = std::ranges::any_of(chunk_.instructions(i), [](const auto& instruction) {
        return bytecode::info(instruction.op).has_target();
      });
      for (std::uint32_t at = chunk_.begin(i); at < chunk_.begin(i + 1); ++at) {
        const auto& instruction = chunk_.code[at];
        if (instruction.op == Op::For)
          last[instruction.a] = tests || instruction.d < chunk_.first_constant() ? none : at;
        else if (instruction.op == Op::Next)
          heads_[at] = last[instruction.a];
      }
    }
  }

  /// A line that is left to the loop is done again from its beginning, so nothing may have
  /// happened.
  bool can_be_machine_code(std::size_t index) const {
    bool changed = false;
    for (std::uint32_t at = chunk_.begin(index); at < chunk_.begin(index + 1); ++at) {
      const auto& instruction = chunk_.code[at];
      const auto& row = bytecode::info(instruction.op);
      if (row.compiled == Compiled::Never || (row.compiled == Compiled::Mostly && changed) ||
          (instruction.op == Op::Next && heads_[at] == none))
        return false;
      changed = changed || instruction.op == Op::StoreElement ||
                (row.operands[0] == 'w' && instruction.a < bytecode::first_temporary);
      if (instruction.ends_line || instruction.op == Op::Goto)
        changed = false; // what stands behind is reached from a test
    }
    return true;
  }

  /// Where lines lead and come from.
  void follow_ways() {
    entered_.resize(chunk_.code.size());
    leads_away_.resize(chunk_.lines.size());
    leads_away_.push_back(true);
    for (std::size_t i = 0; i < chunk_.lines.size(); ++i)
      for (const auto& instruction : chunk_.instructions(i)) {
        const bool jumps = (instruction.ends_line && instruction.target != chunk_.begin(i + 1)) ||
                           instruction.op == Op::Target || instruction.op == Op::Gosub;
        if (jumps && bytecode::info(instruction.op).has_target())
          entered_[instruction.target] = leads_away_[i] = true;
        if (instruction.op == Op::For || instruction.op == Op::Next || instruction.op == Op::Return)
          leads_away_[i] = true;
      }
  }

  Op first_op(std::size_t line) const { return chunk_.code[chunk_.begin(line)].op; }

  /// Writes down the subroutine that a line calls, with those that it calls. False where the way to
  /// its `return` is not certain, or too long.
  bool put_called_by(std::size_t line, std::vector<std::uint32_t> calls, std::size_t most) {
    calls.push_back(chunk_.begin(line + 1));
    const auto target = chunk_.code[chunk_.begin(line)].target;
    const auto first = std::ranges::lower_bound(chunk_.lines, target, {}, &bytecode::Line::begin);
    line = static_cast<std::size_t>(first - chunk_.lines.begin());
    for (; calls.size() <= Frames::gosub_depth && steps_.size() < most; ++line) {
      steps_.push_back({line, calls});
      if (first_op(line) == Op::Return)
        return true;
      const bool calls_on = first_op(line) == Op::Gosub && put_called_by(line, calls, most);
      if (!can_be_machine_code(line) || (leads_away_[line] && !calls_on))
        return false;
    }
    return false;
  }

  /// Blocks end where the program may go elsewhere, and before a line that it may come to.
  void form_blocks() {
    for (std::size_t i = 0; i < chunk_.lines.size(); ++i) {
      steps_.push_back({i, {}});
      const std::size_t size = steps_.size();
      const std::size_t most = std::min(size + NativeCode::longest_block, 4 * chunk_.lines.size());
      if (first_op(i) == Op::Gosub && !put_called_by(i, {}, most))
        steps_.resize(size);
    }
    steps_.push_back({chunk_.lines.size(), {}}); // behind the program
    for (std::size_t i = steps_.size() - 1; i-- > 0;) {
      auto& step = steps_[i];
      const auto& next = steps_[i + 1];
      const bool away = next.calls.empty() && (entered_[chunk_.begin(next.line)] ||
                                               (step.calls.empty() && leads_away_[step.line]));
      if (can_be_machine_code(step.line))
        step.rest = away || next.rest == NativeCode::longest_block ? 1 : next.rest + 1;
    }
  }

  /// The registers that are used most, by a guess: in a loop eight times as often as around it.
  void choose_homes() {
    const std::size_t size = chunk_.code.size();
    std::vector<int> depth(size);
    for (std::uint32_t at = 0; at < size; ++at) {
      const auto& instruction = chunk_.code[at];
      const bool jumps = bytecode::info(instruction.op).has_target();
      for (auto inside = jumps ? instruction.target : heads_[at]; inside <= at; ++inside)
        ++depth[inside];
    }
    std::vector<std::uint64_t> uses(chunk_.register_count() + std::size_t{1});
    for (std::uint32_t at = 0; at < size; ++at) {
      const auto& instruction = chunk_.code[at];
      const auto& row = bytecode::info(instruction.op);
      const std::uint64_t weight = std::uint64_t{1} << 3 * std::min(depth[at], 6);
      const std::array values{instruction.a, instruction.b, instruction.c, instruction.d};
      for (std::size_t i = 0; i < values.size() && row.compiled != Compiled::Never; ++i) {
        if (row.operands[i] != '-' && row.operands[i] != 'n')
          uses[values[i]] += weight;
        if (row.operands[i] == 'p')
          uses[values[i] + 1u] += weight;
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
  std::vector<std::uint32_t> heads_; ///< by instruction, of `next`
  std::vector<bool> entered_;        ///< by instruction
  std::vector<bool> leads_away_;     ///< by line, and of the end
  std::vector<Step> steps_;
  std::vector<std::uint16_t> housed_;
};

/// Writes the code of a program.
class Writer {
public:
  Writer(const Chunk& chunk, const Plan& plan, x86::Assembler& assembler)
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

  /// A place in the code, and in what has been logged of it.
  struct Place {
    std::size_t code = 0;
    std::size_t log = 0;
  };

  /// Returns where the way in begins, then each line, then the way out, then where that ends.
  std::vector<Place> program(const asmjit::StringLogger* log) {
    std::vector<Place> places;
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

  const Label& table() const { return table_; }

private:
  // Entry and exit.

  void enter() {
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

  /// Returns eax, the line that is next.
  void leave() {
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

  void write_tables() {
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

  // Lines.

  const Label& line_of(std::size_t step) const {
    return labels_[chunk_.begin(plan_.steps()[step].line)];
  }

  void write_step(std::size_t number) {
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

  void leave_before(std::uint32_t at) {
    a_.mov(x86::eax, at);
    a_.jmp(exit_);
  }

  /// How a line is entered if it does not begin its block, and how it is left: it has not been
  /// executed then, and neither has the rest of its block.
  void write_door(std::size_t number) {
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

  void write(std::uint32_t at, const Instruction& i) {
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

  /// The same, but in eax where `other`, which is still needed, has that home.
  x86::Gp apart(std::uint16_t index, std::uint16_t other) const {
    return index == other ? x86::Gp(x86::eax) : place_of(index);
  }

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

  void multiply(const Instruction& i, std::optional<std::uint16_t> summand = std::nullopt) {
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

  /// bytecode::divide_by() in edx; spoils eax, returns where b is, which is neither.
  x86::Gp quotient(const Instruction& i) {
    const auto x = loaded(i.b, x86::ecx);
    a_.movsxd(x86::rax, x);
    reciprocals_.emplace_back(a_.newLabel(), bytecode::reciprocal(constant(i.c)));
    a_.imul(x86::qword_ptr(reciprocals_.back().first));
    a_.bt(x, 31);
    a_.adc(x86::edx, 0);
    return x;
  }

  void divide_by(const Instruction& i) {
    quotient(i);
    store(i.a, x86::edx);
  }

  void divide_subtract(const Instruction& i) {
    quotient(i);
    const auto place = place_of(i.a);
    load(place, i.d);
    a_.sub(place, x86::edx);
    store(i.a, place);
  }

  void remainder_by(const Instruction& i, std::optional<std::uint16_t> summand = std::nullopt) {
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

  /// bytecode::before_cut() in `to`; returns where b is, which is not there.
  x86::Gp before_cut(const Instruction& i, const x86::Gp& to) {
    const auto x = loaded(i.b, x86::ecx);
    a_.mov(to, x);
    if (i.d > 1)
      a_.sar(to, 31);
    a_.shr(to, 32 - i.d);
    a_.add(to, x);
    return x;
  }

  void divide_by_power(const Instruction& i) {
    const auto to = apart(i.a, i.b);
    before_cut(i, to);
    a_.sar(to, i.d);
    store(i.a, to);
  }

  void remainder_by_power(const Instruction& i) {
    const auto x = before_cut(i, x86::eax);
    a_.and_(x86::eax, -constant(i.c));
    a_.mov(x86::edx, x);
    a_.sub(x86::edx, x86::eax);
    store(i.a, x86::edx);
  }

  void shift(InstId op, const Instruction& i) {
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

  void absolute(const Instruction& i) {
    load(x86::eax, i.b);
    a_.mov(x86::ecx, x86::eax);
    a_.neg(x86::ecx);
    a_.cmovns(x86::eax, x86::ecx);
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
    a_.emit(x86::Inst::kIdCmp, loaded(left, x86::eax), operand(right));
  }

  void test(const Instruction& i, x86::CondCode jumps) {
    compare(i.a, i.b);
    a_.j(jumps, way_to(i.target));
  }

  void select(std::uint32_t at, const Instruction& i, x86::CondCode takes_first) {
    const auto place = apart(i.a, i.d) == x86::eax ? x86::Gp(x86::ecx) : *homes_[i.a];
    if (i.op == Op::SelectClear)
      a_.emit(x86::Inst::kIdTest, loaded(i.b, x86::eax),
              is_constant(i.c) ? operand(i.c) : Operand(loaded(i.c, x86::ecx)));
    else
      compare(i.b, i.c);
    load(place, static_cast<std::uint16_t>(i.d + 1)); // a move leaves the flags alone
    a_.emit(x86::Inst::cmovccFromCond(takes_first), place, operand(i.d));
    store(i.a, place);
    jump(at, following_);
  }

  // Control.

  void jump(std::uint32_t at, std::uint32_t target) {
    if (target != at + 1)
      a_.jmp(way_to(target));
  }

  /// Within a block the following line has been counted.
  const Label& way_to(std::uint32_t target) const {
    return target == following_ ? ins_[step_ + 1] : labels_[target];
  }

  void begin_loop(std::uint32_t at, const Instruction& i) {
    const auto again = a_.newLabel();
    load(x86::edx, i.d == i.a ? i.b : i.d); // the start is assigned first
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

  /// The loop that runs is most probably that of the `for` above: its first line tells.
  void end_loop(std::uint32_t at, const Instruction& i) {
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

  /// The frames into rcx, the number of calls that are open into eax.
  void load_calls() {
    a_.mov(x86::rcx, frames_at);
    a_.mov(x86::eax, x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)));
  }

  void open_calls(const std::vector<std::uint32_t>& places) {
    for (const auto place : places) {
      a_.mov(x86::dword_ptr(x86::rcx, x86::rax, 2, offsetof(Frames, calls)), place);
      a_.add(x86::eax, 1);
    }
    a_.mov(x86::dword_ptr(x86::rcx, offsetof(Frames, call_depth)), x86::eax);
  }

  /// A subroutine that is written behind its call is in no frame until it is left.
  void call(std::uint32_t at, const Instruction& i) {
    load_calls();
    a_.cmp(x86::eax, Frames::gosub_depth - plan_.steps()[step_].calls.size());
    a_.jae(leave_);
    if (plan_.is_called(step_ + 1))
      return;
    open_calls({following_});
    jump(at, i.target);
  }

  void come_back() {
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

  const Chunk& chunk_;
  const Plan& plan_;
  x86::Assembler& a_;
  std::vector<std::optional<x86::Gp>> homes_; ///< by register of the program
  std::vector<Label> labels_;                 ///< by instruction
  std::vector<Label> ins_;                    ///< by step
  std::vector<Label> outs_;                   ///< by step
  std::vector<std::pair<Label, std::int64_t>> reciprocals_;
  Label exit_;
  Label table_;
  // Of the line that is being written.
  std::size_t step_ = 0;
  Label leave_;
  std::uint32_t following_ = 0;
};

/// The finished code of a program, not yet in memory of its own.
struct Draft final : asmjit::ErrorHandler {
  explicit Draft(const Chunk& chunk, asmjit::StringLogger* log = nullptr) {
    code.init(asmjit::Environment::host());
    code.setErrorHandler(this);
    code.setLogger(log);
    x86::Assembler assembler(&code);
    const Plan plan(chunk);
    Writer writer(chunk, plan, assembler);
    places = writer.program(log);
    code.flatten();
    code.resolveUnresolvedLinks();
    failed = failed || code.hasUnresolvedLinks();
    table = code.labelOffset(writer.table());
  }

  void handleError(asmjit::Error, const char*, asmjit::BaseEmitter*) override { failed = true; }

  bool failed = false; ///< something could not be written; the writer does not ask each time
  asmjit::CodeHolder code;
  std::vector<Writer::Place> places;
  std::size_t table = 0;
};

} // namespace

bool has_native_code() {
  return true;
}

tl::expected<std::unique_ptr<NativeCode>, std::string_view>
NativeCode::compile(const Chunk& chunk) {
  namespace memory = asmjit::VirtMem;
  constexpr std::string_view denied = "this system does not let memory become executable";
  if (chunk.code.size() > most_instructions)
    return tl::unexpected(too_large);
  Draft draft(chunk);
  if (draft.failed)
    return tl::unexpected(too_large);
  std::unique_ptr<NativeCode> made(new NativeCode);
  made->size_ = draft.code.codeSize();
  if (memory::alloc(&made->memory_, made->size_, memory::MemoryFlags::kAccessRW) != 0)
    return tl::unexpected(denied);
  draft.code.relocateToBase(reinterpret_cast<std::uintptr_t>(made->memory_));
  draft.code.copyFlattenedData(made->memory_, made->size_);
  if (draft.failed)
    return tl::unexpected(too_large);
  if (memory::protect(made->memory_, made->size_, memory::MemoryFlags::kAccessRX) != 0)
    return tl::unexpected(denied);
  char* const base = static_cast<char*>(made->memory_);
  made->table_ = reinterpret_cast<const void* const*>(base + draft.table);
  for (std::size_t i = 0; i + 1 < draft.places.size(); ++i) {
    const bool is_line = i > 0 && i <= chunk.lines.size();
    made->pieces_.push_back({is_line ? chunk.lines[i - 1].number : 0, base + draft.places[i].code,
                             draft.places[i + 1].code - draft.places[i].code});
  }
  return made;
}

NativeCode::~NativeCode() {
  if (memory_)
    asmjit::VirtMem::release(memory_, size_);
}

void NativeCode::run(Core& core) const {
  const auto enter = reinterpret_cast<Entry>(memory_);
  const void* const line = table_[core.index_of(core.pc)];
  core.pc = core.code.data() + enter(core.registers.data(), &core.frames, &core.budget, line);
}

NativeListing native_listing(const Chunk& chunk) {
  asmjit::StringLogger log;
  log.setIndentation(asmjit::FormatIndentationGroup::kCode, 10);
  log.setIndentation(asmjit::FormatIndentationGroup::kLabel, 8);
  const Draft draft(chunk, &log);
  std::vector<std::string> pieces;
  for (std::size_t i = 0; i + 1 < draft.places.size(); ++i)
    pieces.emplace_back(log.data() + draft.places[i].log,
                        draft.places[i + 1].log - draft.places[i].log);
  return {pieces.front(), {pieces.begin() + 1, pieces.end() - 1}, pieces.back()};
}

#else

bool has_native_code() {
  return false;
}
tl::expected<std::unique_ptr<NativeCode>, std::string_view> NativeCode::compile(const Chunk&) {
  return tl::unexpected(std::string_view("this build knows no machine code"));
}
NativeCode::~NativeCode() = default;
void NativeCode::run(Core&) const {}
NativeListing native_listing(const Chunk&) {
  return {};
}

#endif
} // namespace orb::vm
