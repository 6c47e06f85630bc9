#pragma once

// Angles and times of the model, in degrees and seconds.

#include "base/time.h"
#include "spec/ball.h"
#include "vm/body/trigonometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orb::vm {

inline constexpr double half_circle = spec::ball::full_circle / 2.0;
inline constexpr double to_radians = std::numbers::pi / half_circle;

/// One step of the control system.
inline constexpr Duration control_step =
    Duration{std::chrono::seconds{1}} / spec::ball::control_rate;
inline constexpr double step_s = 1.0 / spec::ball::control_rate;

/// Returns the same direction, 0 <= degrees < 360.
inline double wrap_360(double degrees) {
  if (0 <= degrees && degrees < spec::ball::full_circle)
    return degrees; // the common case: std::fmod costs ten times as much
  const double wrapped = std::fmod(degrees, static_cast<double>(spec::ball::full_circle));
  return wrapped < 0 ? wrapped + spec::ball::full_circle : wrapped;
}

/// Returns the nearest whole heading, 0 to 359.
inline int whole_heading(double degrees) {
  return static_cast<int>(wrap_360(static_cast<double>(std::lround(degrees))));
}

/// Returns the shortest turn, -180 < turn <= 180.
inline double shortest_turn(double from_deg, double to_deg) {
  const double way = wrap_360(to_deg - from_deg);
  return way > half_circle ? way - spec::ball::full_circle : way;
}

/// Moves `value` toward `target` by at most `most`.
inline double toward(double value, double target, double most) {
  return value < target ? std::min(value + most, target) : std::max(value - most, target);
}

inline double seconds(Duration duration) {
  return static_cast<double>(duration.count()) * 1e-9;
}

} // namespace orb::vm
