#pragma once

// Private to assembler/.

#include "assembler/assemble.h"

#include <vector>

namespace orb::assembler {

/// Whether it is that command, and is whole.
bool is(const PlacedCommand& command, spec::MacroCommand kind);

/// What macros do too early, while something else goes on: fades and rotations that are cut short,
/// rolls that are ignored.
std::vector<Diagnostic> lint_timing(const Source& source, const Assembly& assembly);

} // namespace orb::assembler
