#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// The goal of the optimisation.
enum class Shape : std::uint8_t {
  Shortest,  ///< for upload to a robot
  Steppable, ///< every statement keeps its own lines in their place, for stepping line by line
};

/// Makes the program shorter and faster without changing its behaviour; deterministic. Afterwards
/// every line has a form that the robot has.
void optimise(Code& code, Shape shape);

} // namespace orb::structured
