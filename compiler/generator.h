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

/// Registers of constants get their final number when the temporaries have been counted.
inline constexpr std::uint16_t constant_mark = 0x8000;
/// Of constants and of texts.
inline constexpr std::size_t most_registers = 0x7F00;

/// The row of a relation among the four that begin with the one for `=`.
constexpr Op with_relation(Op equal, Relation relation) {
  return static_cast<Op>(static_cast<std::size_t>(equal) + static_cast<std::size_t>(relation));
}
static_assert(with_relation(Op::UnlessEqual, Relation::Greater) == Op::UnlessGreater &&
              with_relation(Op::WhenEqual, Relation::Less) == Op::WhenLess &&
              with_relation(Op::SelectEqual, Relation::NotEqual) == Op::SelectNotEqual);

/// Emits instructions in the order of the text: whatever an expression does (fail, draw a random
/// number, clear what it reads) happens where it is written.
class Generator {
public:
  explicit Generator(const Program& program) : program_(program) {}

  Chunk run();

private:
  std::uint32_t here() const { return static_cast<std::uint32_t>(chunk_.code.size()); }

  std::uint32_t emit(Op op, std::uint16_t a = 0, std::uint16_t b = 0, std::uint16_t c = 0,
                     std::uint16_t d = 0);

  /// The line ends with what was emitted last.
  void end_line() { chunk_.code.back().ends_line = true; }

  /// Leads instruction `at` to a line; false where there is none of that number.
  bool lead_to(std::uint32_t at, std::uint32_t number);

  void resolve();

  /// No text that fits a ball runs out of registers; of one that does, the line is a trap.
  void give_up(std::uint32_t begin);

  void trap(BasicError error) { emit(Op::Trap, spec::code(error)); }

  // Registers. The stack holds those of the values that have been computed and not yet used.

  std::uint16_t constant(std::int32_t value);

  std::optional<std::int32_t> constant_in(std::uint16_t index) const;

  static bool is_temporary(std::uint16_t index);

  /// The temporary that belongs to a place on the stack: a value is in nobody's way there.
  std::uint16_t temporary(std::size_t place);

  std::uint16_t pop();

  // Values.

  /// Emits what computes the next value on the stack.
  void compute(Op op, std::uint16_t b = 0, std::uint16_t c = 0, std::uint16_t d = 0);

  /// Combines the two topmost values.
  void combine(Operator written);

  void divide_by_constant(Op op, std::uint16_t left, std::uint16_t right, std::uint32_t divisor);

  /// Where the value on the right was computed last: both operations in one instruction, if any.
  bool join(Op op, std::uint16_t left, std::uint16_t right);

  /// Whether a temporary has been computed by the last instruction before `end`, which is an `op`.
  bool is_last(Op op, std::uint16_t to, std::uint32_t end) const;

  void negate();

  /// The first node of the first level too many: it is noticed where that opens.
  std::uint32_t too_deep(std::uint32_t root) const;

  /// Computes an expression: its register, which is also put on the stack. Nothing when it traps.
  std::optional<std::uint16_t> value(std::uint32_t root);

  void move(std::uint16_t to, std::uint16_t from);

  /// Computes expressions into temporaries side by side: the first one; nothing when one traps.
  std::optional<std::uint16_t> side_by_side(std::span<const Item> items);

  bool is_leaf(std::uint32_t root) const;

  // Lines.

  void statement(const StatementNode& node);

  /// Sets a variable to a value.
  void store(const Item& variable, std::uint16_t from);

  void assign(const LetView& let);

  /// `if … then v = x else v = y` where x and y can neither fail nor be noticed: both are computed
  /// and one is taken, so that the processor has no jump to guess.
  bool select(const StatementNode& node, Relation relation, std::uint16_t left,
              std::uint16_t right);

  void branch(Op op, const BranchView& branch);

  void choose(Op op, const OnView& on);

  void begin_loop(const ForView& loop);

  void end_loop(const Item& variable);

  static Relation relation_of(const Comparison& comparison);

  /// Puts the registers of both sides on the stack. False when one traps.
  bool compare(const Comparison& comparison);

  void decide(const StatementNode& node);

  /// Behind a `then` that has an `else`: what falls through goes on at the next line. The
  /// instruction that leads there; none where nothing falls through.
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
  std::vector<std::uint32_t> begins_; ///< by line of the program: its instruction, or the next one
  std::vector<std::pair<std::uint32_t, std::uint32_t>> jumps_; ///< from instruction to line
  std::vector<std::uint16_t> stack_;
  bool overflow_ = false;
};

} // namespace orb::compiler
