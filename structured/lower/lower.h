#pragma once

#include "structured/lower/code.h"
#include "structured/lower/lowering_plan.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Lowers a program without findings to lines of the robot, without optimisation: every value that
/// must be computed before another gets a temporary, every block its labels. The optimiser removes
/// what is unnecessary.
Code lower(const Program& program, const Names& names, const Plan& plan);

} // namespace orb::structured
