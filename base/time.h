#pragma once

#include <chrono>
#include <cstdint>

namespace orb {

/// All times of the project: signed 64-bit nanoseconds, a range of 292 years.
using Duration = std::chrono::nanoseconds;

/// The time line of `Instant`. It has no `now()`: only the edge reads a clock; all other code is
/// handed the time.
struct TimeLine {
  using rep = Duration::rep;
  using period = Duration::period;
  using duration = Duration;
  using time_point = std::chrono::time_point<TimeLine, Duration>;
  static constexpr bool is_steady = true;
};

using Instant = TimeLine::time_point;

/// Later than every other moment: `next_event()` returns it if nothing will happen by itself.
inline constexpr Instant never = Instant::max();

using namespace std::chrono_literals;

} // namespace orb
