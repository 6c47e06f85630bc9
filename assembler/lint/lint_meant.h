#pragma once

// Private to assembler/.

#include "assembler/assemble.h"

#include <vector>

namespace orb::assembler {

/// Finds valid commands that the author probably did not mean, judged by the rest of the file.
std::vector<Diagnostic> lint_meant(const Source& source, const Assembly& assembly);

} // namespace orb::assembler
