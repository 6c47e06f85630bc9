#pragma once

#include "spec/ball.h"

#include <cstdint>
#include <optional>
#include <string>

namespace orb::vm {

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct Quaternion {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
};

/// Where the ball is: locator coordinates, heading as commanded, speed over ground.
struct Pose {
  double x_cm = 0;
  double y_cm = 0;
  double heading_deg = 0;
  double speed_cm_s = 0;
};

/// A place in centimetres; where nothing else is said, of the world in which the ball woke up at
/// 0,0 facing +Y.
struct Point {
  double x = 0;
  double y = 0;

  friend constexpr bool operator==(Point, Point) = default;
};

/// A place or a velocity, x to the right and y ahead, in a robot's own axes; and back.
constexpr Point in_axes(spec::Axes axes, Point p) {
  return axes == spec::Axes::AheadLeft ? Point{p.y, -p.x} : p;
}
constexpr Point from_axes(spec::Axes axes, Point p) {
  return axes == spec::Axes::AheadLeft ? Point{-p.y, p.x} : p;
}

/// Where a ball starts in its world, and which way it faces there: degrees clockwise from +Y.
struct Placement {
  Point place;
  double facing_deg = 0;

  friend constexpr bool operator==(const Placement&, const Placement&) = default;
};

/// A straight wall: endless at `x=` or `y=`, or between two points.
struct Wall {
  enum class Axis : std::uint8_t { X, Y, None };
  Axis axis = Axis::X;
  double at_cm = 0; ///< of an endless one
  Point from{};     ///< of one along no axis
  Point to{};

  static constexpr Wall between(Point from, Point to) { return {Axis::None, 0, from, to}; }
  friend constexpr bool operator==(const Wall&, const Wall&) = default;
};

/// `x=70`, or `-30,50 to 30,50` of a wall between two points.
std::string to_string(const Wall& wall);

/// The point of a wall between two points that is nearest to `place`.
Point nearest_point(const Wall& wall, Point place);

/// A blow as the accelerometer sees it: positive y is a blow on the front, positive x one on the
/// right (Source: LL §Collision Detection).
struct Impact {
  double x_power = 0; ///< compared with the thresholds of the X axis
  double y_power = 0;
  int speed = 0;            ///< 0..255 at the moment of the blow
  std::optional<Wall> wall; ///< what it ran into; nothing for a push
};

} // namespace orb::vm
