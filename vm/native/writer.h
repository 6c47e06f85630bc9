#pragma once

#include "bytecode/chunk.h"
#include "vm/native/plan.h"

#include <array>
#include <asmjit/x86.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace orb::vm::native {

namespace x86 = asmjit::x86;
using asmjit::Imm;
using asmjit::Label;
using asmjit::Operand;
using bytecode::Chunk;
using bytecode::Instruction;
using bytecode::Op;
using InstId = asmjit::InstId;

// Where things are while machine code runs. The most used registers of the program live in those
// of the processor; the others, and all of them outside, in memory at `r`.
inline const x86::Gp r = x86::rbx;
inline const x86::Gp budget = x86::rbp;
inline const std::array homes{x86::esi,  x86::edi,  x86::r8d,  x86::r9d,  x86::r10d,
                              x86::r11d, x86::r12d, x86::r13d, x86::r14d, x86::r15d};
inline const std::array saved{x86::rbx, x86::rbp, x86::r12, x86::r13, x86::r14, x86::r15};
inline const x86::Mem loop_at = x86::qword_ptr(x86::rsp); ///< Frames::loop
inline const x86::Mem frames_at = x86::qword_ptr(x86::rsp, 8);
static_assert(homes.size() == most_homes);

/// Writes the code of a program.
class Writer {
public:
  Writer(const Chunk& chunk, const Plan& plan, x86::Assembler& assembler);

  /// A place in the code, and in what has been logged of it.
  struct Place {
    std::size_t code = 0;
    std::size_t log = 0;
  };

  /// Returns where the way in begins, then each line, then the way out, then where that ends.
  std::vector<Place> program(const asmjit::StringLogger* log);

  const Label& table() const { return table_; }

private:
  // Entry and exit.

  void enter();

  /// Returns eax, the line that is next.
  void leave();

  void write_tables();

  // Lines.

  const Label& line_of(std::size_t step) const;

  void write_step(std::size_t number);

  void leave_before(std::uint32_t at);

  /// How a line is entered if it does not begin its block, and how it is left: it has not been
  /// executed then, and neither has the rest of its block.
  void write_door(std::size_t number);

  void write(std::uint32_t at, const Instruction& i);

  // Operands. eax, ecx and edx are free within an instruction.

  bool is_constant(std::uint16_t index) const { return index >= chunk_.first_constant(); }
  std::int32_t constant(std::uint16_t index) const;
  static x86::Mem memory(std::uint16_t index) { return x86::dword_ptr(r, 4 * index); }

  Operand operand(std::uint16_t index) const;

  void load(const x86::Gp& to, std::uint16_t index);

  /// The value in a register of the processor: its own, or `scratch`.
  x86::Gp loaded(std::uint16_t index, const x86::Gp& scratch);

  /// Where a result is computed: in its home, or in eax.
  x86::Gp place_of(std::uint16_t index) const { return homes_[index].value_or(x86::eax); }

  /// The same, but in eax where `other`, which is still needed, has that home.
  x86::Gp apart(std::uint16_t index, std::uint16_t other) const;

  void store(std::uint16_t index, const x86::Gp& from);

  // Values.

  void copy(std::uint16_t to, std::uint16_t from);

  void set(const x86::Mem& to, std::uint16_t from);

  void calculate(InstId op, std::uint16_t to, std::uint16_t left, std::uint16_t right);

  void multiply(const Instruction& i, std::optional<std::uint16_t> summand = std::nullopt);

  /// The loop divides by 0 and by -1, whose quotient may not fit.
  void divide(const Instruction& i, const x86::Gp& result);

  /// bytecode::divide_by() in edx; spoils eax, returns where b is, which is neither.
  x86::Gp quotient(const Instruction& i);

  void divide_by(const Instruction& i);

  void divide_subtract(const Instruction& i);

  void remainder_by(const Instruction& i, std::optional<std::uint16_t> summand = std::nullopt);

  /// bytecode::before_cut() in `to`; returns where b is, which is not there.
  x86::Gp before_cut(const Instruction& i, const x86::Gp& to);

  void divide_by_power(const Instruction& i);

  void remainder_by_power(const Instruction& i);

  void shift(InstId op, const Instruction& i);

  void absolute(const Instruction& i);

  /// The element of Z that Y names; spoils eax.
  x86::Mem element();

  void load_element(const Instruction& i);

  void store_element(const Instruction& i) { set(element(), i.a); }

  // Decisions.

  void compare(std::uint16_t left, std::uint16_t right);

  void test(const Instruction& i, x86::CondCode jumps);

  void select(std::uint32_t at, const Instruction& i, x86::CondCode takes_first);

  // Control.

  void jump(std::uint32_t at, std::uint32_t target);

  /// Within a block the following line has been counted.
  const Label& way_to(std::uint32_t target) const;

  void begin_loop(std::uint32_t at, const Instruction& i);

  /// The loop that runs is most probably that of the `for` above: its first line tells.
  void end_loop(std::uint32_t at, const Instruction& i);

  /// The frames into rcx, the number of calls that are open into eax.
  void load_calls();

  void open_calls(const std::vector<std::uint32_t>& places);

  /// A subroutine that is written behind its call is in no frame until it is left.
  void call(std::uint32_t at, const Instruction& i);

  void come_back();

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

} // namespace orb::vm::native
