#pragma once

#include "playground/engine/request.h"
#include "protocol/decoder.h"

// What is said to a robot, and heard from it, when something has been brought onto it.

namespace orb::playground {

/// The packets that start (`what`: "run") what a request brings, or stop ("stop") all that runs and
/// the wheels.
Answer tell_robot(Request& request);

/// Finds what a robot prints in bytes that arrive in pieces of any size.
class RobotEar {
public:
  /// What was printed, and what an error said, with `bytes` of the request.
  Answer hear(Request& request);

private:
  protocol::Decoder decoder_{protocol::Direction::FromBall};
};

} // namespace orb::playground
