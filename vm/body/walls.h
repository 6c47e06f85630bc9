#pragma once

#include "vm/body/drivetrain.h"
#include "vm/body/place.h"

#include <optional>
#include <vector>

namespace orb::vm {

/// A blow against a wall: the speed into it, cm/s in world axes, and how fast the ball was then.
struct Blow {
  double vx = 0;
  double vy = 0;
  double speed = 0;
  Wall wall;
};

/// What the ball can run into.
class Walls {
public:
  /// `ball` is where the ball is now: on which side it stays.
  void add(const Wall& wall, Point ball);
  bool empty() const { return endless_.empty() && segments_.empty(); }
  /// On the way from `from` to `place`: moves `place` out of the walls, turns the drive back, and
  /// says what blow that was, if one.
  std::optional<Blow> meet(Point from, Point& place, Drivetrain& drive);

private:
  void hit_endless(Point& place, Drivetrain& drive, std::optional<Blow>& blow) const;
  void hit_segments(Point from, Point& place, Drivetrain& drive, std::optional<Blow>& blow);
  bool push_out(Point from, Point& place, Drivetrain& drive, std::optional<Blow>& blow);

  struct Obstacle {
    Wall wall;
    double side; ///< +1 or -1: where the ball was when the wall appeared
  };
  std::vector<Obstacle> endless_;
  std::vector<Wall> segments_; ///< between two points
  double clear_cm_ = 0;        ///< so far it can go before it may touch one of these
};

} // namespace orb::vm
