#pragma once

#include "base/exit_code.h"
#include "run/held_robot.h"
#include "spec/robots.h"

#include <functional>
#include <tl/expected.hpp>
#include <vector>

// The measuring drive of `orb calibrate`.

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

/// A piece of the drive that begins at rest; times count from its first order. A longer gap in the
/// samples makes it `broken`.
struct Leg {
  std::vector<Order> orders;
  std::vector<Seen> seen;
  bool broken = false;
};

/// The robot stays within this distance of its starting place, along each axis.
inline constexpr double square_half_cm = 100;

/// An upper bound.
Duration course_time();

/// Drives the course. Each leg heads for free space, so that the robot stays in the square; the
/// first is slow and short, later ones are as fast and long as the earlier ones allow. Fails if the
/// robot is too fast for the square, leaves it or hits something. Whatever the result, the caller
/// must then hold the robot. Calls `tell` after each leg with the number of legs done and their
/// total.
tl::expected<std::vector<Leg>, Failure> drive_course(HeldRobot& robot, spec::Robot which,
                                                     const std::function<void(int, int)>& tell);

} // namespace orb::run
