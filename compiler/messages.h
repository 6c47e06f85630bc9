#pragma once

#include "base/diagnostic.h"
#include "compiler/program.h"

namespace orb::compiler {

/// Puts into words why a line does not parse, with the rewrite where there is one.
Diagnostic explain(const Program& program, const Fault& fault);

} // namespace orb::compiler
