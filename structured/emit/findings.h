#pragma once

#include "compiler/lint/lint.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Adds the findings of the linter: bad values, loops that never wait, a ball left driving. `lines`
/// is the program as made by source_lines().
void find_meaning(Program& program, const Names& names, const compiler::Program& lines,
                  const compiler::Target& target);

} // namespace orb::structured
