#pragma once

#include "bytecode/chunk.h"
#include "vm/machine/core.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::vm::native {

/// How many program registers are kept in processor registers.
inline constexpr std::size_t most_homes = 10;
/// No instruction.
inline constexpr std::uint32_t none = UINT32_MAX;

/// Decisions made before the code of a program is written.
class Plan {
public:
  explicit Plan(const bytecode::Chunk& chunk);

  /// A line at the place where its code is written: in order, or inlined after a call, if it
  /// belongs to a short subroutine.
  struct Step {
    std::size_t line = 0;
    std::vector<std::uint32_t> calls; ///< return addresses of its inlined calls, outermost first
    /// Lines left in its block, including this one; a block shares one check of the budget. 0 if
    /// the loop runs the line.
    int rest = 0;
  };
  const std::vector<Step>& steps() const { return steps_; }
  bool begins_block(std::size_t step) const { return step == 0 || steps_[step - 1].rest <= 1; }
  bool is_called(std::size_t step) const { return !steps_[step].calls.empty(); }
  /// The `for` matching a `next`; none if they cannot be matched statically.
  std::uint32_t head_of(std::uint32_t next) const { return heads_[next]; }
  /// The program registers kept in processor registers, one for each of `homes`.
  std::span<const std::uint16_t> housed() const { return housed_; }

private:
  /// Matches each `next` with the last `for` of its variable above. Machine code recognises a
  /// running loop by its first line, so no other loop may share that line, and the step must be a
  /// constant.
  void match_loops();

  /// Returns true if machine code can run the line. A line that is handed to the loop is restarted
  /// from its beginning, so nothing may have changed before that.
  bool can_be_machine_code(std::size_t index) const;

  /// Finds the lines that jump, and the places they jump to.
  void follow_ways();

  bytecode::Op first_op(std::size_t line) const { return chunk_.code[chunk_.begin(line)].op; }

  /// Inlines the subroutine called by a line, and those it calls. Returns false if the path to its
  /// `return` is uncertain or too long.
  bool put_called_by(std::size_t line, std::vector<std::uint32_t> calls, std::size_t most);

  /// Divides lines into blocks. A block ends after a line that may jump and before a line that may
  /// be jumped to.
  void form_blocks();

  /// Chooses the most used registers. Estimate: each loop level multiplies the uses by eight.
  void choose_homes();

  const bytecode::Chunk& chunk_;
  std::vector<std::uint32_t> heads_; ///< by instruction, for `next`
  std::vector<bool> entered_;        ///< by instruction: may be jumped to
  std::vector<bool> leads_away_;     ///< by line, and one for the end: may jump
  std::vector<Step> steps_;
  std::vector<std::uint16_t> housed_;
};

} // namespace orb::vm::native
