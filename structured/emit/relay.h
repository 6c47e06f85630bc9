#pragma once

#include "compiler/lint/lint.h"
#include "structured/emit/compiled.h"

namespace orb::structured {

/// Looks at the robot's lines with the linter of plain programs and says what it finds of the
/// source: values that are wrong for certain, loops that never wait, a program that does not fit.
/// Keeps the lines that it has parsed, and their packed image.
void relay_findings(Compiled& compiled, const compiler::Target& target);

/// Says that a program is far too large for any robot.
void report_too_large(Compiled& compiled, const compiler::Target& target);

} // namespace orb::structured
