#pragma once

#include "bytecode/chunk.h"
#include "vm/machine/core.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::vm::native {

/// How many registers of a program live in those of the processor.
inline constexpr std::size_t most_homes = 10;
/// No instruction.
inline constexpr std::uint32_t none = UINT32_MAX;

/// What is decided about a program before its code is written.
class Plan {
public:
  explicit Plan(const bytecode::Chunk& chunk);

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
  void match_loops();

  /// A line that is left to the loop is done again from its beginning, so nothing may have
  /// happened.
  bool can_be_machine_code(std::size_t index) const;

  /// Where lines lead and come from.
  void follow_ways();

  bytecode::Op first_op(std::size_t line) const { return chunk_.code[chunk_.begin(line)].op; }

  /// Writes down the subroutine that a line calls, with those that it calls. False where the way to
  /// its `return` is not certain, or too long.
  bool put_called_by(std::size_t line, std::vector<std::uint32_t> calls, std::size_t most);

  /// Blocks end where the program may go elsewhere, and before a line that it may come to.
  void form_blocks();

  /// The registers that are used most, by a guess: in a loop eight times as often as around it.
  void choose_homes();

  const bytecode::Chunk& chunk_;
  std::vector<std::uint32_t> heads_; ///< by instruction, of `next`
  std::vector<bool> entered_;        ///< by instruction
  std::vector<bool> leads_away_;     ///< by line, and of the end
  std::vector<Step> steps_;
  std::vector<std::uint16_t> housed_;
};

} // namespace orb::vm::native
