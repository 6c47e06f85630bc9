#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Turns counting loops into loops of the robot, whose `next` counts, tests and jumps in one line.
/// An early exit makes its round the last and closes the loop by a second `next`; no other pass
/// understands that, so this pass comes last. Variables that share a letter count as one.
void count_loops(Code& code, const Identity& identity);

} // namespace orb::structured
