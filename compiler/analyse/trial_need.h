#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/text/program.h"

namespace orb::compiler {

/// Whether some value may stop the program, as far as can be seen from all that its letters are
/// set to, in whatever order. A trial of other programs would find nothing.
bool needs_trial(const Program& program, const Flow& flow);

} // namespace orb::compiler
