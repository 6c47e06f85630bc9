#pragma once

#include "base/diagnostic.h"
#include "compiler/text/program.h"

#include <optional>

namespace orb::compiler {

/// Puts into words why a line does not parse, with the rewrite where there is one. Nothing for a
/// line that only lacks its number: which one it gets depends on the other lines.
std::optional<Diagnostic> explain(const Program& program, const Fault& fault);

/// Whether the text that does not parse may have been meant to jump, loop, call or end. Where it
/// may, nothing is known about how the lines around it follow each other.
bool may_steer(const Program& program, const Fault& fault);

} // namespace orb::compiler
