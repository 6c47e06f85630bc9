#include "vm/body/walls.h"
#include "vm/body/trigonometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::vm {

using namespace spec::ball; // figures of the model

std::string to_string(const Wall& wall) {
  switch (wall.axis) {
  case Wall::Axis::X: return fmt::format("x={:g}", wall.at_cm);
  case Wall::Axis::Y: return fmt::format("y={:g}", wall.at_cm);
  case Wall::Axis::None: break;
  }
  return fmt::format("{:g},{:g} to {:g},{:g}", wall.from.x, wall.from.y, wall.to.x, wall.to.y);
}

Point nearest_point(const Wall& wall, Point place) {
  const Point along{wall.to.x - wall.from.x, wall.to.y - wall.from.y};
  const double length_squared = along.x * along.x + along.y * along.y;
  if (length_squared == 0)
    return wall.from;
  const double share =
      ((place.x - wall.from.x) * along.x + (place.y - wall.from.y) * along.y) / length_squared;
  const double inside = std::clamp(share, 0.0, 1.0);
  return {wall.from.x + inside * along.x, wall.from.y + inside * along.y};
}

namespace {

/// Removes the speed into a wall: keeps the part along it and turns back a share of the rest.
/// `normal` points from the wall to the ball.
void bounce(const Wall& wall, Point normal, Drivetrain& drive, std::optional<Blow>& blow) {
  const auto going = drive.course();
  const double into = going.vx * normal.x + going.vy * normal.y;
  if (into >= 0)
    return;
  const bool hard = -into >= least_blow;
  if (hard)
    blow = {into * normal.x, into * normal.y, going.speed, wall};
  const double taken = into * (hard ? 1 + restitution : 1);
  drive.bounce({going.vx - taken * normal.x, going.vy - taken * normal.y});
}

} // namespace

void Walls::add(const Wall& wall, Point ball) {
  if (wall.axis == Wall::Axis::None) {
    segments_.push_back(wall);
    clear_cm_ = 0;
    return;
  }
  const double place = wall.axis == Wall::Axis::X ? ball.x : ball.y;
  endless_.push_back({wall, place < wall.at_cm ? -1.0 : 1.0});
}

std::optional<Blow> Walls::meet(Point from, Point& place, Drivetrain& drive) {
  std::optional<Blow> blow;
  if (!endless_.empty())
    hit_endless(place, drive, blow);
  if (!segments_.empty())
    hit_segments(from, place, drive, blow);
  return blow;
}

void Walls::hit_endless(Point& place, Drivetrain& drive, std::optional<Blow>& blow) const {
  const auto going = drive.course();
  for (const auto& [wall, side] : endless_) {
    const bool across_x = wall.axis == Wall::Axis::X;
    double& along = across_x ? place.x : place.y;
    const double speed = across_x ? going.vx : going.vy;
    const double nearest = wall.at_cm + side * radius;
    const bool through = side > 0 ? along < nearest : along > nearest;
    if (!through)
      continue;
    along = nearest;
    if (speed * side >= 0)
      continue;
    const bool hard = std::abs(speed) >= least_blow;
    if (hard)
      blow = {across_x ? speed : 0, across_x ? 0 : speed, drive.course().speed, wall};
    // Keeps the velocity along the wall and turns back a share of the rest.
    const double back = hard ? -restitution * speed : 0;
    drive.bounce(across_x ? Point{back, going.vy} : Point{going.vx, back});
  }
}

void Walls::hit_segments(Point from, Point& place, Drivetrain& drive, std::optional<Blow>& blow) {
  const double way = vm::length(place.x - from.x, place.y - from.y);
  if (way < clear_cm_) {
    clear_cm_ -= way;
    return;
  }
  // Pieces short enough that none jumps over a wall.
  const double pieces = std::ceil(way / (radius / 2));
  const Point piece{(place.x - from.x) / pieces, (place.y - from.y) / pieces};
  place = from;
  for (double done = 0; done < pieces; ++done) {
    place = {place.x + piece.x, place.y + piece.y};
    if (push_out(from, place, drive, blow))
      break; // the blow consumes the rest of the step
  }
}

/// Moves the ball out of the walls it overlaps. Returns true if it touched one.
bool Walls::push_out(Point from, Point& place, Drivetrain& drive, std::optional<Blow>& blow) {
  constexpr int most_rounds = 4; // leaving one wall of a corner may lead into the other
  constexpr double touch = radius - 1e-9;
  bool touched = false;
  for (int round = 0; round < most_rounds; ++round) {
    double nearest = HUGE_VAL;
    for (const auto& wall : segments_) {
      const auto foot = nearest_point(wall, place);
      const double distance = vm::length(place.x - foot.x, place.y - foot.y);
      nearest = std::min(nearest, distance);
      if (distance >= touch || distance == 0)
        continue;
      touched = true;
      const Point normal{(place.x - foot.x) / distance, (place.y - foot.y) / distance};
      place = {foot.x + normal.x * radius, foot.y + normal.y * radius};
      bounce(wall, normal, drive, blow);
    }
    clear_cm_ = std::max(0.0, nearest - radius);
    if (nearest >= touch)
      return touched;
  }
  place = from; // a corner too narrow for the ball: it stays at its old place
  return true;
}

} // namespace orb::vm
