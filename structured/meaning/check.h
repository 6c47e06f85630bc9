#pragma once

#include "compiler/lint/lint.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Reports what is wrong with statements whose names are known: where they stand, how many values
/// they take, which of them must be constant, what the target does not have.
void check(Program& program, const Names& names, const compiler::Target& target);

/// The routines that each routine calls, as indices, each once.
std::vector<std::vector<std::uint32_t>> calls_of(const Program& program, const Names& names);

} // namespace orb::structured
