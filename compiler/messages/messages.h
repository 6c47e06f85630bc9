#pragma once

#include "base/diagnostic.h"
#include "compiler/text/program.h"

#include <optional>

namespace orb::compiler {

/// Explains why a line does not parse, with a rewrite if there is one. Returns nothing for a line
/// that only lacks its number: the number depends on the other lines.
std::optional<Diagnostic> explain(const Program& program, const Fault& fault);

/// True if the text that does not parse may be a jump, loop, call or end. If so, the control flow
/// of the lines around it is unknown.
bool may_steer(const Program& program, const Fault& fault);

} // namespace orb::compiler
