#pragma once

#include "compiler/analyse/range.h"
#include "structured/analyse/flow.h"

#include <optional>
#include <vector>

namespace orb::structured {

/// What the values of a comparison's left side can be where it holds; nothing: it cannot hold.
std::optional<compiler::Range> where(Comparison comparison, compiler::Range left,
                                     compiler::Range right);

/// What is known of each variable at a place of the program. Nothing is known of those that are
/// neither read later nor set to a number.
using State = std::vector<compiler::Range>;

/// Which values the variables of a program can have, found by following all its ways.
class Ranges {
public:
  explicit Ranges(const Code& code) : code_(code), flow_(read_flow(code)) {}

  /// False where that would take too long: then nothing is known.
  bool follow();

  compiler::Range range_of(std::uint32_t term, const State& state) const;

  /// Narrows what a relation compares to where `comparison` holds; false where it cannot.
  bool narrow(const Relation& relation, Comparison comparison, State& state) const;

  /// Whether anything comes to a block.
  bool reaches(std::uint32_t block) const { return reached_[block]; }

  /// Calls `visit(line, state)` with each line that can run and the state before it, and
  /// `end(block, state)` with that at the end of each block that is run to its end.
  template <typename Visit, typename End>
  void each_state(Visit visit, End end) {
    State state(code_.variables.size());
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      if (!reached_[b])
        continue;
      load(b, state); // what is not tracked is set before it is read
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
    each_state(visit, [](std::uint32_t, const State&) {});
  }

  const Flow& flow() const { return flow_; }

private:
  /// What comes back from the calls of a routine.
  struct Returned {
    std::vector<std::uint32_t> written; ///< the variables that it sets and that matter afterwards
    std::vector<compiler::Range> known; ///< of these
    std::vector<std::uint32_t> callers; ///< blocks
    bool yet = false;                   ///< it has come back
  };

  void find_tracked();
  void find_landmarks();
  void find_data();

  void load(std::uint32_t b, State& state) const;
  void enter(std::uint32_t b, const State& state);
  void wait(std::uint32_t b);
  void visit(std::uint32_t b);

  void set_element(compiler::Range range);
  bool step(std::uint32_t b, const CodeLine& line, State& state);
  void set(const CodeLine& line, State& state);
  bool call(std::uint32_t routine, State& state, std::uint32_t from);

  void leave(std::uint32_t b, const CodeLine& line, State& state);
  void leave_routine(std::uint32_t routine, const State& state);
  void leave_if(std::uint32_t b, const CodeLine& line, State& state);
  void leave_next(std::uint32_t b, const CodeLine& line, State& state);
  void leave_switch(const CodeLine& line, State& state);
  void leave_on(const CodeLine& line, State& state);
  void enter_where(const Relation& relation, Comparison comparison, std::uint32_t b, State& state);

  const Code& code_;
  Flow flow_;
  std::vector<std::uint32_t> tracked_; ///< variables, block after block
  std::vector<std::uint32_t> begins_;  ///< of each block: where its variables begin; and the end
  std::vector<compiler::Range> known_; ///< of each tracked variable, at the begin of the block
  std::vector<bool> reached_;          ///< of each block
  std::vector<std::uint32_t> visits_;
  State state_;                        ///< of the block that is visited
  std::vector<std::uint64_t> waiting_; ///< blocks to visit, as bits
  std::size_t first_waiting_ = 0;      ///< no word before this one has any
  bool following_ = false;             ///< states are still being found
  std::vector<compiler::Range> ends_;  ///< of each loop's label: its end value
  std::vector<std::uint32_t> nexts_;   ///< of each loop's label: the block that ends in its `next`
  std::vector<Returned> returns_;
  std::vector<std::int32_t> landmarks_;
  compiler::Range data_;
  compiler::Range elements_ = compiler::Range::only(0); ///< of all arrays
  std::vector<std::uint32_t> element_readers_;          ///< blocks
  std::uint32_t growths_ = 0;                           ///< of `elements_`
};

/// How a comparison ends.
enum class Outcome : std::uint8_t { Unknown, Always, Never };
Outcome outcome_of(const Ranges& ranges, const Relation& relation, const State& state);

/// The label that an `on` certainly leads to, or none.
std::uint32_t chosen_label(const Code& code, const Ranges& ranges, const CodeLine& on,
                           const State& state);

} // namespace orb::structured
