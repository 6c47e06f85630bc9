#pragma once

#include "compiler/analyse/range.h"
#include "compiler/analyse/value.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::compiler {

/// How often a block is followed before growing ranges are widened, so that the analysis ends.
inline constexpr std::uint32_t patience = 2;

/// What is known of a variable whose range another path grows from `before` to `joined`.
inline Range widened(std::span<const std::int32_t> landmarks, Range before, Range joined,
                     std::uint32_t visits) {
  constexpr std::uint32_t limit = 64;
  if (visits <= patience || joined == before)
    return joined;
  return visits > limit ? Range{} : widen(landmarks, before, joined);
}

/// The same for a value. A range that grows for long has no exact ends.
inline Value widened(std::span<const std::int32_t> landmarks, const Value& before,
                     const Value& joined, std::uint32_t visits) {
  if (visits <= patience || joined.range == before.range)
    return joined;
  return {widened(landmarks, before.range, joined.range, visits), false, false, joined.origin,
          joined.narrowed};
}

/// The fixed point of a data-flow analysis: what is known of the variables before each block of a
/// program, and after each of its routines. The caller follows the lines of a block; a block whose
/// state has changed since waits to be followed again.
template <typename Known>
class States {
public:
  /// Adds the next block, with the variables whose values matter at its start.
  void add_block(std::span<const std::uint32_t> variables) {
    tracked_.insert(tracked_.end(), variables.begin(), variables.end());
    begins_.push_back(static_cast<std::uint32_t>(tracked_.size()));
    known_.resize(tracked_.size());
    blocks_.emplace_back();
  }
  /// Adds the next routine, with its first block, or none, and the variables that it sets.
  void add_routine(std::uint32_t entry, std::vector<std::uint32_t> written) {
    routines_.push_back({entry, std::move(written), {}, {}});
  }
  /// Ascending, with the least and the greatest number.
  void set_landmarks(std::vector<std::int32_t> landmarks) { landmarks_ = std::move(landmarks); }
  std::span<const std::int32_t> landmarks() const { return landmarks_; }

  /// True if a path reaches the block.
  bool reaches(std::uint32_t block) const { return blocks_[block].reached; }

  /// Sets the variables of a block to what is known before it.
  template <typename State>
  void load(std::uint32_t block, State& state) const {
    for (auto i = begins_[block]; i < begins_[block + 1]; ++i)
      state[tracked_[i]] = known_[i];
  }

  /// Adds a path that reaches the block with this state.
  template <typename State>
  void enter(std::uint32_t block, const State& state) {
    auto& at = blocks_[block];
    bool changed = !at.reached;
    for (auto i = begins_[block]; i < begins_[block + 1]; ++i)
      if (!at.reached)
        known_[i] = state[tracked_[i]];
      else
        changed = grow(known_[i], state[tracked_[i]], at.visits) || changed;
    at.reached = true;
    if (changed)
      wait(block);
  }

  /// Calls a routine from a block, or not any more if the analysis has ended: changes the state to
  /// that after it. Returns false if the routine has not returned yet.
  template <typename State>
  bool call(std::uint32_t routine, std::uint32_t from, State& state) {
    auto& called = routines_[routine];
    if (called.entry != none)
      enter(called.entry, state);
    if (std::find(called.callers.begin(), called.callers.end(), from) == called.callers.end())
      called.callers.push_back(from);
    return load_returned(routine, state);
  }
  template <typename State>
  bool load_returned(std::uint32_t routine, State& state) const {
    const auto& called = routines_[routine];
    for (std::size_t i = 0; i < called.known.size(); ++i)
      state[called.written[i]] = called.known[i];
    return called.returned;
  }

  /// Adds a return from the routine with this state.
  template <typename State>
  void leave(std::uint32_t routine, const State& state) {
    auto& left = routines_[routine];
    bool changed = !left.returned;
    left.known.resize(left.written.size());
    for (std::size_t i = 0; i < left.written.size(); ++i)
      if (!left.returned)
        left.known[i] = state[left.written[i]];
      else // the result of a recursive routine would grow by a step each time
        changed = grow(left.known[i], state[left.written[i]], left.growths) || changed;
    left.returned = true;
    if (!changed)
      return;
    ++left.growths;
    for (const auto caller : left.callers)
      wait(caller);
  }

  /// Lets a block be followed again.
  void wait(std::uint32_t block) {
    blocks_[block].waiting = true;
    first_waiting_ = std::min(first_waiting_, block);
  }

  /// Takes the next block to follow; `none` at the fixed point.
  std::uint32_t take() {
    for (; first_waiting_ < blocks_.size(); ++first_waiting_) {
      auto& block = blocks_[first_waiting_];
      if (!block.waiting)
        continue;
      block.waiting = false;
      ++block.visits;
      return first_waiting_;
    }
    return none;
  }

private:
  struct Block {
    std::uint32_t visits = 0;
    bool reached = false;
    bool waiting = false;
  };
  struct Routine {
    std::uint32_t entry = 0;
    std::vector<std::uint32_t> written;
    std::vector<Known> known;           ///< of those, after its returns
    std::vector<std::uint32_t> callers; ///< blocks
    std::uint32_t growths = 0;          ///< how often its result grew
    bool returned = false;
  };

  bool grow(Known& into, const Known& from, std::uint32_t visits) const {
    if (into == from)
      return false;
    const auto joined = widened(landmarks_, into, join(into, from), visits);
    if (joined == into)
      return false;
    into = joined;
    return true;
  }

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> tracked_;   ///< variables, block after block
  std::vector<std::uint32_t> begins_{0}; ///< where those of each block begin, and the end
  std::vector<Known> known_;             ///< of each tracked variable, at the start of its block
  std::vector<Routine> routines_;
  std::vector<std::int32_t> landmarks_;
  std::uint32_t first_waiting_ = 0;
};

} // namespace orb::compiler
