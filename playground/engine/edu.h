#pragma once

#include "playground/engine/edu_hands.h"
#include "playground/engine/floor.h"
#include "playground/engine/request.h"

#include <functional>
#include <map>
#include <memory>

namespace orb::playground {

/// Robots of a floor that Edu programs drive.
class EduRuns {
public:
  /// Connects to a robot, prepares it and starts the time of its program. `linked`: the robot is on
  /// the browser's link, and the floor's robot shows what it does. Call it again with the bytes
  /// that arrived (see Reins) while the answer has a `wish`.
  Answer start(robot::Robot& robot, Request& request);
  /// Executes the program's calls, then advances to `until` (seconds of the program) or until
  /// something happens to the robot; on a link no time passes here.
  Answer step(robot::Robot& robot, Request& request);
  /// Sends pending commands, calls `arrived` and stops the robot; on a link, call it again until it
  /// answers `stopped`.
  Answer end(robot::Robot& robot, Request& request, const std::function<void()>& arrived);
  /// Must be called before a robot is deleted; without an argument, before all are.
  void forget(const robot::Robot* robot);

private:
  struct Run;
  std::map<const robot::Robot*, std::shared_ptr<Run>> runs_;
};

} // namespace orb::playground
