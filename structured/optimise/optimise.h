#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// What a program becomes.
enum class Shape : std::uint8_t {
  Shortest,  ///< what is sent to a robot
  Steppable, ///< each statement keeps lines of its own, in its place: for who goes line by line
};

/// Makes lines fewer and shorter without changing what they do; the same result for the same
/// program, always. Afterwards every line has a form that the robot has.
void optimise(Code& code, Shape shape);

} // namespace orb::structured
