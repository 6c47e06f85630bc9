#pragma once

// Private to assembler/.

#include "assembler/assemble.h"

#include <vector>

namespace orb::assembler {

/// True if it is this command, without errors.
bool is(const PlacedCommand& command, spec::MacroCommand kind);

/// Finds commands that come too early: fades and rotations that are cut short, rolls that are
/// ignored.
std::vector<Diagnostic> lint_timing(const Source& source, const Assembly& assembly);

} // namespace orb::assembler
