#pragma once

// Shared by the parts of the timeline. Private to timeline*.cpp.

#include "debug/timeline.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace orb::debug {

/// How many queries go by between two calls of GiveUp.
inline constexpr std::uint32_t questions_between_looks = 1 << 14;

/// A snapshot of the ball and of the timeline's counters.
struct Timeline::Copy {
  Moment at;
  std::unique_ptr<vm::Ball> ball;
  std::uint64_t commands = 0;
  std::uint64_t events = 0;
  std::size_t applied = 0;
};

/// One pass through a run.
struct Timeline::Search {
  Watch* watch = nullptr;                 ///< null: searches for nothing
  const GiveUp* give_up = nullptr;        ///< null: cannot be interrupted
  std::optional<Moment> bound = {};       ///< where to stop
  Instant until = never;                  ///< where to stop, as a time
  std::optional<std::uint64_t> skip = {}; ///< step to ignore: the search starts before it
  std::optional<Moment> gather_to = {};   ///< records finds before this moment and goes on

  // Results.
  bool at_bound = false;
  bool found = false;
  bool closed = false; ///< nothing may begin any more
  /// time of a found event; the run may go on to the end of that instant
  std::optional<Instant> hit{};
  std::optional<Moment> last{}; ///< last recorded find
  std::uint32_t questions = 0;

  void note(const Moment& moment) {
    if (!(moment < *gather_to))
      return;
    last = moment;
    watch->noted();
  }
  bool unwanted() {
    if (give_up == nullptr || ++questions < questions_between_looks)
      return false;
    questions = 0;
    closed = (*give_up)();
    return closed;
  }
};

} // namespace orb::debug
