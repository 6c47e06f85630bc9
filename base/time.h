#pragma once

#include <chrono>
#include <cstdint>

namespace orb {

/// All times of the project: signed 64-bit nanoseconds, which hold 292 years.
using Duration = std::chrono::nanoseconds;

/// Names the time line that `Instant` lies on. It has no `now()`: only the edge reads a clock,
/// everything else is handed the time.
struct TimeLine {
  using rep = Duration::rep;
  using period = Duration::period;
  using duration = Duration;
  using time_point = std::chrono::time_point<TimeLine, Duration>;
  static constexpr bool is_steady = true;
};

using Instant = TimeLine::time_point;

/// The moment after everything: what `next_event()` says when nothing will happen by itself.
inline constexpr Instant never = Instant::max();

using namespace std::chrono_literals;

} // namespace orb
