#pragma once

#include "bytecode/chunk.h"
#include "vm/machine/native/register_plan.h"

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

// Register assignment in machine code. The most used program registers live in processor registers;
// the others, and all of them outside machine code, in memory at `r`.
inline const x86::Gp r = x86::rbx;
inline const x86::Gp budget = x86::rbp;
inline const std::array homes{x86::esi,  x86::edi,  x86::r8d,  x86::r9d,  x86::r10d,
                              x86::r11d, x86::r12d, x86::r13d, x86::r14d, x86::r15d};
inline const std::array saved{x86::rbx, x86::rbp, x86::r12, x86::r13, x86::r14, x86::r15};
inline const x86::Mem loop_at = x86::qword_ptr(x86::rsp); ///< Frames::loop
inline const x86::Mem frames_at = x86::qword_ptr(x86::rsp, 8);
static_assert(homes.size() == most_homes);

/// Writes the machine code of a program. Large because each kind of instruction has its own member.
class Writer {
public:
  Writer(const Chunk& chunk, const Plan& plan, x86::Assembler& assembler);

  /// An offset in the code, and in its listing.
  struct CodePlace {
    std::size_t code = 0;
    std::size_t log = 0;
  };

  /// Writes the program. Returns the start of the entry code, of each line and of the exit code,
  /// and the end.
  std::vector<CodePlace> program(const asmjit::StringLogger* log);

  const Label& table() const { return table_; }

private:
  // Entry and exit.

  void enter();

  /// Leaves machine code; eax holds the next line.
  void leave();

  void write_tables();

  // Lines.

  const Label& line_of(std::size_t step) const;

  void write_step(std::size_t number);

  void leave_before(std::uint32_t at);

  /// Writes the entry of a line inside a block, and its exit before execution: it gives back the
  /// budget for the line and the rest of its block.
  void write_door(std::size_t number);

  void write(std::uint32_t at, const Instruction& i);

  // Operands. eax, ecx and edx are free within an instruction.

  bool is_constant(std::uint16_t index) const { return index >= chunk_.first_constant(); }
  std::int32_t constant(std::uint16_t index) const;
  static x86::Mem memory(std::uint16_t index) { return x86::dword_ptr(r, 4 * index); }

  Operand operand(std::uint16_t index) const;

  void load(const x86::Gp& to, std::uint16_t index);

  /// Returns the value in a processor register: its own, or `scratch`.
  x86::Gp loaded(std::uint16_t index, const x86::Gp& scratch);

  /// The register for a result: its home, or eax.
  x86::Gp place_of(std::uint16_t index) const { return homes_[index].value_or(x86::eax); }

  /// As place_of(), but eax if `other`, which is still needed, has the same home.
  x86::Gp apart(std::uint16_t index, std::uint16_t other) const;

  void store(std::uint16_t index, const x86::Gp& from);

  // Values.

  void copy(std::uint16_t to, std::uint16_t from);

  void set(const x86::Mem& to, std::uint16_t from);

  void calculate(InstId op, std::uint16_t to, std::uint16_t left, std::uint16_t right);

  void multiply(const Instruction& i, std::optional<std::uint16_t> summand = std::nullopt);

  /// Leaves division by 0 and by -1, whose quotient may overflow, to the loop.
  void divide(const Instruction& i, const x86::Gp& result);

  /// bytecode::divide_by() into edx. Clobbers eax; returns the register of b, which is neither.
  x86::Gp quotient(const Instruction& i);

  void divide_by(const Instruction& i);

  void divide_subtract(const Instruction& i);

  void remainder_by(const Instruction& i, std::optional<std::uint16_t> summand = std::nullopt);

  /// bytecode::before_cut() into `to`; returns the register of b, which differs.
  x86::Gp before_cut(const Instruction& i, const x86::Gp& to);

  void divide_by_power(const Instruction& i);

  void remainder_by_power(const Instruction& i);

  void shift(InstId op, const Instruction& i);

  void absolute(const Instruction& i);

  /// The element of Z selected by Y; clobbers eax.
  x86::Mem element();

  void load_element(const Instruction& i);

  void store_element(const Instruction& i) { set(element(), i.a); }

  // Decisions.

  void compare(std::uint16_t left, std::uint16_t right);

  void test(const Instruction& i, x86::CondCode jumps);

  void select(std::uint32_t at, const Instruction& i, x86::CondCode takes_first);

  // Control.

  void jump(std::uint32_t at, std::uint32_t target);

  /// Returns the label to jump to. Within a block it skips the budget check of the following line.
  const Label& way_to(std::uint32_t target) const;

  void begin_loop(std::uint32_t at, const Instruction& i);

  /// The running loop is very likely that of the matching `for`; compares its first line to be
  /// sure.
  void end_loop(std::uint32_t at, const Instruction& i);

  /// Loads the frames into rcx and the number of open calls into eax.
  void load_calls();

  void open_calls(const std::vector<std::uint32_t>& places);

  /// An inlined subroutine is pushed on the frames only if machine code is left inside it.
  void call(std::uint32_t at, const Instruction& i);

  void come_back();

  const Chunk& chunk_;
  const Plan& plan_;
  x86::Assembler& a_;
  std::vector<std::optional<x86::Gp>> homes_; ///< by program register
  std::vector<Label> labels_;                 ///< by instruction
  std::vector<Label> ins_;                    ///< entries, by step
  std::vector<Label> outs_;                   ///< exits, by step
  std::vector<std::pair<Label, std::int64_t>> reciprocals_;
  Label exit_;
  Label table_;
  // State of the line being written.
  std::size_t step_ = 0;
  Label leave_;
  std::uint32_t following_ = 0;
};

} // namespace orb::vm::native
