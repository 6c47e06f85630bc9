#pragma once

#include "vm/body/drivetrain.h"
#include "vm/body/place.h"

#include <optional>
#include <vector>

namespace orb::vm {

/// A blow against a wall: the velocity into it, cm/s in world axes, and the ball's speed at that
/// moment.
struct Blow {
  double vx = 0;
  double vy = 0;
  double speed = 0;
  Wall wall;
};

/// The walls of the world.
class Walls {
public:
  /// Adds a wall. `ball` is the ball's present place, which determines the side it stays on.
  void add(const Wall& wall, Point ball);
  bool empty() const { return endless_.empty() && segments_.empty(); }
  /// Moves from `from` to `place`: keeps `place` out of the walls and turns the drive back. Returns
  /// the blow, if there was one.
  std::optional<Blow> meet(Point from, Point& place, Drivetrain& drive);

private:
  void hit_endless(Point& place, Drivetrain& drive, std::optional<Blow>& blow) const;
  void hit_segments(Point from, Point& place, Drivetrain& drive, std::optional<Blow>& blow);
  bool push_out(Point from, Point& place, Drivetrain& drive, std::optional<Blow>& blow);

  struct Obstacle {
    Wall wall;
    double side; ///< +1 or -1: the side of the ball when the wall appeared
  };
  std::vector<Obstacle> endless_;
  std::vector<Wall> segments_; ///< between two points
  double clear_cm_ = 0;        ///< distance the ball can certainly go before it touches a segment
};

} // namespace orb::vm
