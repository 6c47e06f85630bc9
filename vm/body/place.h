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

/// Locator coordinates, heading as commanded, speed over ground.
struct Pose {
  double x_cm = 0;
  double y_cm = 0;
  double heading_deg = 0;
  double speed_cm_s = 0;
};

/// A place in centimetres. By default in the world where the ball started at 0,0 facing +Y.
struct Point {
  double x = 0;
  double y = 0;

  friend constexpr bool operator==(Point, Point) = default;
};

/// Convert a place or velocity (x to the right, y ahead) to a robot's own axes, and back.
constexpr Point in_axes(spec::Axes axes, Point p) {
  return axes == spec::Axes::AheadLeft ? Point{p.y, -p.x} : p;
}
constexpr Point from_axes(spec::Axes axes, Point p) {
  return axes == spec::Axes::AheadLeft ? Point{-p.y, p.x} : p;
}

/// The starting place of a ball in its world and the direction it faces, in degrees clockwise from
/// +Y.
struct Placement {
  Point place;
  double facing_deg = 0;

  friend constexpr bool operator==(const Placement&, const Placement&) = default;
};

/// A straight wall: infinite at `x=` or `y=`, or between two points.
struct Wall {
  enum class Axis : std::uint8_t { X, Y, None };
  Axis axis = Axis::X;
  double at_cm = 0; ///< of an infinite wall
  Point from{};     ///< of a wall between two points
  Point to{};

  static constexpr Wall between(Point from, Point to) { return {Axis::None, 0, from, to}; }
  friend constexpr bool operator==(const Wall&, const Wall&) = default;
};

/// Returns `x=70`, or `-30,50 to 30,50` for a wall between two points.
std::string to_string(const Wall& wall);

/// Returns the point of a wall between two points that is nearest to `place`.
Point nearest_point(const Wall& wall, Point place);

/// A blow as the accelerometer senses it: positive y hits the front, positive x the right (Source:
/// LL §Collision Detection).
struct Impact {
  double x_power = 0; ///< compared with the thresholds of the X axis
  double y_power = 0;
  int speed = 0;            ///< 0..255 at the moment of the blow
  std::optional<Wall> wall; ///< the wall it hit; nullopt for a push
};

} // namespace orb::vm
