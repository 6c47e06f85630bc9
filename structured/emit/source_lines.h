#pragma once

#include "compiler/text/program.h"
#include "structured/lower/code.h"
#include "structured/text/program.h"

namespace orb::structured {

/// Converts a lowered, unoptimised program for the linter of numbered programs: its lines have no
/// text, and their statements and values refer to the source. The result refers to the text of
/// `program`.
compiler::Program source_lines(const Program& program, const Code& code);

} // namespace orb::structured
