#pragma once

#include "base/exit_code.h"
#include "run/held_robot.h"
#include "spec/robots.h"

#include <functional>
#include <tl/expected.hpp>
#include <vector>

// The drive from which `orb calibrate` tells how a robot drives.

namespace orb::run {

struct Order {
  Duration at{};
  int heading_deg = 0;
  int speed = 0; ///< 0 to 255
  vm::Go go = vm::Go::Drive;
};

struct Seen {
  Duration at{};
  vm::Point place_cm;
  double yaw_deg = 0;
};

/// A piece of the drive that begins at rest; its times count from its first order. Once nothing has
/// been seen for a while in it, it is `broken`.
struct Leg {
  std::vector<Order> orders;
  std::vector<Seen> seen;
  bool broken = false;
};

/// Within this distance of where it stood, along each axis, the robot stays.
inline constexpr double square_half_cm = 100;

/// It takes no longer.
Duration course_time();

/// Drives the course. Each leg leads to where the square is free, so that the robot stays in it:
/// the first is slow and short, each later one is as fast and long as those before it allow. Fails
/// where the robot is too fast for so small a square, leaves it or runs into something. However it
/// ends, the robot is to be held then. `tell` hears after each leg how many of how many are done.
tl::expected<std::vector<Leg>, Failure> drive_course(HeldRobot& robot, spec::Robot which,
                                                     const std::function<void(int, int)>& tell);

} // namespace orb::run
