#pragma once

// Private to assembler/.

#include "assembler/assemble.h"

#include <vector>

namespace orb::assembler {

/// Finds loops without an end, ends without a loop, nested loops, and loops of zero rounds or one.
std::vector<Diagnostic> lint_loops(const Source& source, const Assembly& assembly);

} // namespace orb::assembler
