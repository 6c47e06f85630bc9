#pragma once

#include "bytecode/arithmetic.h"
#include "bytecode/op.h"
#include "compiler/generate.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

namespace orb::compiler {

using bytecode::Chunk;
using bytecode::Ends;
using bytecode::Op;
using spec::BasicError;
using spec::Function;
using spec::Operator;
using spec::Relation;
using spec::Statement;

/// Marks registers of constants. They get their final number once the temporaries are counted.
inline constexpr std::uint16_t constant_mark = 0x8000;
/// Limit for constants and for texts.
inline constexpr std::size_t most_registers = 0x7F00;

/// Selects the row of a relation among the four that begin with the one for `=`.
constexpr Op with_relation(Op equal, Relation relation) {
  return static_cast<Op>(static_cast<std::size_t>(equal) + static_cast<std::size_t>(relation));
}
static_assert(with_relation(Op::UnlessEqual, Relation::Greater) == Op::UnlessGreater &&
              with_relation(Op::WhenEqual, Relation::Less) == Op::WhenLess &&
              with_relation(Op::SelectEqual, Relation::NotEqual) == Op::SelectNotEqual);

/// Emits instructions in text order: the side effects of an expression (failing, drawing a random
/// number, clearing a sensor) happen where it is written. Large because each kind of statement and
/// operation has its own member, and all of them share the code and the stack of registers.
class Generator {
public:
  explicit Generator(const Program& program) : program_(program) {}

  Chunk run();

private:
  std::uint32_t here() const { return static_cast<std::uint32_t>(chunk_.code.size()); }

  std::uint32_t emit(Op op, std::uint16_t a = 0, std::uint16_t b = 0, std::uint16_t c = 0,
                     std::uint16_t d = 0);

  /// Ends the line at the last instruction.
  void end_line() { chunk_.code.back().ends_line = true; }

  /// Sets the target of instruction `at` to a line; returns false if there is no such line.
  bool lead_to(std::uint32_t at, std::uint32_t number);

  void resolve();

  /// Replaces a line that runs out of registers by a trap. No program that fits into a ball does.
  void give_up(std::uint32_t begin);

  void trap(BasicError error) { emit(Op::Trap, spec::code(error)); }

  // Registers. The stack holds those of computed values that are still in use.

  std::uint16_t constant(std::int32_t value);

  std::optional<std::int32_t> constant_in(std::uint16_t index) const;

  static bool is_temporary(std::uint16_t index);

  /// The temporary reserved for a stack position, so that no other value overwrites it.
  std::uint16_t temporary(std::size_t place);

  std::uint16_t pop();

  // Values.

  /// Emits the instruction that computes the next value on the stack.
  void compute(Op op, std::uint16_t b = 0, std::uint16_t c = 0, std::uint16_t d = 0);

  /// Combines the two topmost values.
  void combine(Operator written);

  void divide_by_constant(Op op, std::uint16_t left, std::uint16_t right, std::uint32_t divisor);

  /// Fuses two operations into one instruction if the right value was computed last. Returns true
  /// if it did.
  bool join(Op op, std::uint16_t left, std::uint16_t right);

  /// True if the last instruction before `end` is an `op` that computed the temporary.
  bool is_last(Op op, std::uint16_t to, std::uint32_t end) const;

  void negate();

  /// The first node of the first level that is too deep; the robot notices it where that level
  /// opens.
  std::uint32_t too_deep(std::uint32_t root) const;

  /// Computes an expression into a register, pushes the register and returns it. Returns nothing if
  /// it traps.
  std::optional<std::uint16_t> value(std::uint32_t root);

  void move(std::uint16_t to, std::uint16_t from);

  /// Computes expressions into consecutive temporaries and returns the first. Returns nothing if
  /// one traps.
  std::optional<std::uint16_t> side_by_side(std::span<const Item> items);

  bool is_leaf(std::uint32_t root) const;

  // Lines.

  void statement(const StatementNode& node);

  /// Assigns a value to a variable.
  void store(const Item& variable, std::uint16_t from);

  void assign(const LetView& let);

  /// Compiles `if … then v = x else v = y` without a jump if x and y can neither fail nor have side
  /// effects: computes both and selects one, which spares the processor a branch prediction.
  bool select(const StatementNode& node, Relation relation, std::uint16_t left,
              std::uint16_t right);

  void branch(Op op, const BranchView& branch);

  void choose(Op op, const OnView& on);

  void begin_loop(const ForView& loop);

  void end_loop(const Item& variable);

  static Relation relation_of(const Comparison& comparison);

  /// Pushes the registers of both sides. Returns false if one traps.
  bool compare(const Comparison& comparison);

  void decide(const StatementNode& node);

  /// Emits the jump over `else` after a `then` branch; returns the instruction, or none if nothing
  /// falls through.
  std::uint32_t leave_branch();

  void print(std::span<const Item> items);

  void text(std::string_view quoted);

  void input(const InputView& input);

  void data(std::span<const Item> items);

  void read(std::span<const Item> items);

  void perform(Statement kind, std::span<const Item> items);

  const Program& program_;
  Chunk chunk_;
  std::unordered_map<std::uint32_t, std::uint32_t> line_of_;
  std::unordered_map<std::int32_t, std::uint16_t> constants_;
  std::vector<std::uint32_t> begins_; ///< by line of the program: its instruction, or that of the
                                      ///< next line
  std::vector<std::pair<std::uint32_t, std::uint32_t>> jumps_; ///< from instruction to line
  std::vector<std::uint16_t> stack_;
  bool overflow_ = false;
};

} // namespace orb::compiler
