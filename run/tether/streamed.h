#pragma once

#include "run/input.h"

#include <span>

namespace orb::run {

/// What a robot is asked to stream besides where it is, how fast and how it lies: a link carries
/// the more samples, the smaller they are.
struct Streamed {
  bool acceleration = true;
  bool rotation = true; ///< the rates of turning
  bool attitude = true; ///< as a quaternion, where the robot has one to tell
};

/// What the programs among the inputs read.
Streamed read_by(std::span<const Input> inputs);

} // namespace orb::run
