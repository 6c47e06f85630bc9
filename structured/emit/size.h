#pragma once

#include "compiler/lint/lint.h"
#include "structured/emit/compiled.h"

namespace orb::structured {

/// Reports that the packed lines of a program do not fit into the robot, or only into newer ones.
void check_size(Compiled& compiled, const compiler::Target& target);

/// Reports that a program is far too large for any robot.
void report_too_large(Compiled& compiled, const compiler::Target& target);

} // namespace orb::structured
