#pragma once

#include "structured/lower/code.h"
#include "structured/lower/plan.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Writes a program without findings as lines of the robot, plainly: every value that must be
/// computed before another gets a temporary, every block its labels. The optimiser takes out what
/// was not needed.
Code lower(const Program& program, const Names& names, const Plan& plan);

} // namespace orb::structured
