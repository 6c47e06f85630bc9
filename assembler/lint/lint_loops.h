#pragma once

// Private to assembler/.

#include "assembler/assemble.h"

#include <vector>

namespace orb::assembler {

/// Loops without an end, ends without a loop, loops in loops and those of no or one round.
std::vector<Diagnostic> lint_loops(const Source& source, const Assembly& assembly);

} // namespace orb::assembler
