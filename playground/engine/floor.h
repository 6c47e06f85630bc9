#pragma once

#include "playground/engine/request.h"
#include "robot/robot.h"

#include <map>
#include <memory>

namespace orb::playground {

/// Robots controlled by bytes from other programs, alone or in worlds, by number.
class Floor {
public:
  Answer add_world(Request& request);
  Answer add_robot(Request& request);
  Answer fork(Request& request);
  Answer end(Request& request);
  /// The robot that a request names.
  tl::expected<robot::Robot*, Problem> find(Request& request);
  /// Gives a robot that is alone its number.
  Answer keep(std::unique_ptr<robot::Robot> robot);

private:
  Answer tell(int number) const;

  std::map<int, std::unique_ptr<robot::World>> worlds_;
  std::map<int, std::unique_ptr<robot::Robot>> alone_;
  std::map<int, robot::Robot*> robots_; ///< all robots of alone_ and worlds_
  int last_ = 0;
};

// Requests to one robot.
Answer link_robot(robot::Robot& robot, Request& request);
/// Writes, then advances the time, then reads what has arrived.
Answer step_robot(robot::Robot& robot, Request& request);
Answer state_of_robot(robot::Robot& robot, Request& request);
Answer stimulate_robot(robot::Robot& robot, Request& request);
Answer reset_robot(robot::Robot& robot, Request& request);
/// Its journey as data for the player, and as a drawing.
Answer journey_of_robot(robot::Robot& robot, Request& request);

} // namespace orb::playground
