#pragma once

#include "compiler/analyse/states.h"
#include "structured/analyse/flow.h"

#include <optional>
#include <vector>

namespace orb::structured {

/// The range of each variable at a program point. Variables that are neither read later nor set to
/// a number are unknown.
using VariableRanges = std::vector<compiler::Range>;

/// Computes the possible values of variables along all paths of a program. Large because the
/// analysis keeps what is known so far for every block, loop, routine and array until nothing
/// changes any more.
class Ranges {
public:
  explicit Ranges(const Code& code) : code_(code), flow_(read_flow(code)) {}

  /// Returns false if it would take too long: then nothing is known.
  bool follow();

  compiler::Range range_of(std::uint32_t term, const VariableRanges& state) const;

  /// Narrows the operands of a relation to where `comparison` holds; returns false if it cannot.
  bool narrow(const Relation& relation, Comparison comparison, VariableRanges& state) const;

  /// True if a block is reachable.
  bool reaches(std::uint32_t block) const { return states_.reaches(block); }

  /// Calls `visit(line, state)` with each reachable line and the state before it, and `end(block,
  /// state)` with the state at the end of each block that completes.
  template <typename Visit, typename End>
  void each_state(Visit visit, End end) {
    VariableRanges state(code_.variables.size());
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      if (!reaches(b))
        continue;
      states_.load(b, state); // an untracked variable is set before it is read
      bool on = true;
      for (auto i = flow_.blocks[b].begin; on && i < flow_.blocks[b].end; ++i) {
        visit(i, state);
        on = step(b, code_.lines[i], state);
      }
      if (on)
        end(b, state);
    }
  }
  template <typename Visit>
  void each_state(Visit visit) {
    each_state(visit, [](std::uint32_t, const VariableRanges&) {});
  }

  const Flow& flow() const { return flow_; }

private:
  void find_tracked();
  void find_landmarks();
  void find_data();

  void enter(std::uint32_t b, const VariableRanges& state);
  void visit(std::uint32_t b);

  void set_element(compiler::Range range);
  bool step(std::uint32_t b, const CodeLine& line, VariableRanges& state);
  void set(const CodeLine& line, VariableRanges& state);

  void leave(std::uint32_t b, const CodeLine& line, VariableRanges& state);
  void leave_if(std::uint32_t b, const CodeLine& line, VariableRanges& state);
  void leave_next(std::uint32_t b, const CodeLine& line, VariableRanges& state);
  void leave_switch(const CodeLine& line, VariableRanges& state);
  void leave_on(const CodeLine& line, VariableRanges& state);
  void enter_where(const Relation& relation, Comparison comparison, std::uint32_t b,
                   VariableRanges& state);

  const Code& code_;
  Flow flow_;
  compiler::States<compiler::Range> states_; ///< by block and routine
  VariableRanges state_;                     ///< of the current block
  bool following_ = false;                   ///< before the fixed point
  std::vector<compiler::Range> ends_;        ///< of each loop's label: its end value
  std::vector<std::uint32_t> nexts_;         ///< of each loop's label: the block with its `next`
  compiler::Range data_;
  compiler::Range elements_ = compiler::Range::only(0); ///< of all arrays
  std::vector<std::uint32_t> element_readers_;          ///< blocks
  std::uint32_t growths_ = 0;                           ///< of `elements_`
};

/// The result of a comparison if it is the same for all values.
std::optional<bool> answer_of(const Ranges& ranges, const Relation& relation,
                              const VariableRanges& state);

/// The label that an `on` certainly jumps to, or none.
std::uint32_t chosen_label(const Code& code, const Ranges& ranges, const CodeLine& on,
                           const VariableRanges& state);

} // namespace orb::structured
