#pragma once

#include "base/diagnostic.h"
#include "compiler/text/program.h"

#include <optional>

namespace orb::compiler {

/// What a fault is about that only the whole program can mend: labels, names of more than one
/// letter, several statements in a line. Nothing for every other fault.
std::optional<Diagnostic> explain_name(const Program& program, const Fault& fault);

} // namespace orb::compiler
