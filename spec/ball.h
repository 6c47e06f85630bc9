#pragma once

// The ball in numbers. The rows are in spec/ball.def.

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>

namespace orb::spec {

namespace ball {
using ms = std::chrono::milliseconds;
#define BALL(type, name, value, unit, source, summary) inline constexpr type name{value};
#include "spec/ball.def"
#undef BALL
} // namespace ball

/// How a robot drives. The defaults are the classic ball's; rows of a robot override them.
struct Driving {
  double speed_offset = ball::speed_offset;
  double speed_slope = ball::speed_slope;
  double full_speed = ball::full_speed;
  double speed_lag = ball::speed_lag;
  double grip = ball::grip;
  double turn_gain = ball::turn_gain;
  int dead_steps = static_cast<int>(ball::dead_time.count()) * ball::control_rate / 1000;
};
/// Battery voltages, in V. The defaults are the classic ball's; rows of a robot override them.
struct Battery {
  double full = ball::full_battery;       ///< at power-on
  double charged = ball::charged_battery; ///< charging ends
  double empty = ball::empty_battery;     ///< lowest shown
  double low = ball::default_low_battery / 100.0;
  double critical = ball::default_critical_battery / 100.0;
};

/// The directions of a robot's own coordinates, relative to its heading at 0,0.
enum class Axes : unsigned char {
  RightAhead, ///< x to the right, y ahead
  AheadLeft   ///< x ahead, y to the left
};

/// The longest dead time, in steps of the control system.
inline constexpr int most_dead_steps = 127;
static_assert(Driving{}.dead_steps <= most_dead_steps);

/// The steady speed for a commanded value, 0 to 255: piecewise linear, three segments, clamped at
/// 0. If the second segment begins below 0, the robot does not move until it rises above.
constexpr double speed_cm_s(const Driving& numbers, int ordered) {
  const auto on_line = [&](int value) {
    return std::max(0.0, numbers.speed_offset + numbers.speed_slope * value);
  };
  if (ordered <= ball::slowest_driven)
    return on_line(ball::slowest_driven) * ordered / ball::slowest_driven;
  if (ordered <= ball::fastest_driven)
    return on_line(ordered);
  const double beyond =
      static_cast<double>(ordered - ball::fastest_driven) / (ball::greatest - ball::fastest_driven);
  return on_line(ball::fastest_driven) * (1 - beyond) + numbers.full_speed * beyond;
}

struct BallNumber {
  std::string_view name; ///< the name of the constant
  double value;
  std::string_view unit; ///< may be empty
  std::string_view source;
  std::string_view summary;
};

/// The same numbers as rows.
inline constexpr auto ball_numbers = std::to_array<BallNumber>({
#define BALL(type, name, value, unit, source, summary) {#name, value, unit, source, summary},
#include "spec/ball.def"
#undef BALL
});

} // namespace orb::spec
