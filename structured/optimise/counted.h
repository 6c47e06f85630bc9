#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Loops that count and are only left at their end become loops of the robot: its `next` counts,
/// tests and jumps in one line. True where there were any.
bool count_loops(Code& code);

} // namespace orb::structured
