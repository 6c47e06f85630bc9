#pragma once

#include "run/input.h"

#include <span>

namespace orb::run {

/// What a robot streams besides place, velocity and attitude angles. Smaller samples let a link
/// carry more of them.
struct Streamed {
  bool acceleration = true;
  bool rotation = true; ///< rotation rates
  bool attitude = true; ///< as a quaternion, if the robot has one
};

/// Returns the sensors that the programs among the inputs read.
Streamed read_by(std::span<const Input> inputs);

} // namespace orb::run
