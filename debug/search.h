#pragma once

// What the parts of the timeline share. Private to timeline*.cpp.

#include "debug/timeline.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace orb::debug {

/// Questions between two looks at whether the search is still wanted.
inline constexpr std::uint32_t questions_between_looks = 1 << 14;

/// A ball as it was at a moment, and what the timeline had counted by then.
struct Timeline::Copy {
  Moment at;
  std::unique_ptr<vm::Ball> ball;
  std::uint64_t commands = 0;
  std::uint64_t events = 0;
  std::size_t applied = 0;
};

/// One way through a run.
struct Timeline::Search {
  Watch* watch = nullptr;                 ///< null: nothing is looked for
  const GiveUp* give_up = nullptr;        ///< null: never
  std::optional<Moment> bound = {};       ///< where it ends
  Instant until = never;                  ///< the same as a time
  std::optional<std::uint64_t> skip = {}; ///< the step that it stands before and does not find
  std::optional<Moment> gather_to = {};   ///< finds before this are noted, and it goes on

  // What has come of it.
  bool at_bound = false;
  bool found = false;
  bool closed = false;          ///< nothing may begin any more
  std::optional<Instant> hit{}; ///< an event was found; where the run stands then is still open
  std::optional<Moment> last{}; ///< the last find that was noted
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
