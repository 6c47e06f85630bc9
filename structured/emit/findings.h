#pragma once

#include "compiler/lint/lint.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Adds what the linter finds in a program: values that are wrong, loops that never wait, a ball
/// left driving. `lines` is the program as source_lines() gives it.
void find_meaning(Program& program, const Names& names, const compiler::Program& lines,
                  const compiler::Target& target);

} // namespace orb::structured
