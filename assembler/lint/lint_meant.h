#pragma once

// Private to assembler/.

#include "assembler/assemble.h"

#include <vector>

namespace orb::assembler {

/// Commands that are valid and hardly meant so, by what the rest of the file does.
std::vector<Diagnostic> lint_meant(const Source& source, const Assembly& assembly);

} // namespace orb::assembler
