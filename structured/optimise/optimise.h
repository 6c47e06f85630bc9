#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// All passes that make lines fewer and shorter without changing what they do; the same result for
/// the same program, always. Afterwards every line has a form that the robot has.
void optimise(Code& code);

} // namespace orb::structured
