#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Loops that count become loops of the robot: its `next` counts, tests and jumps in one line.
/// Where one is left before its end, that turn is made the last and a second `next` ends it, which
/// no other pass knows: this comes last. Variables that share a letter are one.
void count_loops(Code& code, const Identity& identity);

} // namespace orb::structured
