#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/text/program.h"

namespace orb::compiler {

/// True if some value may stop the program, judged by all assignments in any order. If false, a
/// trial would find nothing and can be skipped.
bool needs_trial(const Program& program, const Flow& flow);

} // namespace orb::compiler
