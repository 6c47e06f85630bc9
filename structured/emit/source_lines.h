#pragma once

#include "compiler/text/program.h"
#include "structured/lower/code.h"
#include "structured/text/program.h"

namespace orb::structured {

/// A program that has been lowered, and nothing more, as the linter of numbered programs reads one:
/// lines without a text of their own, whose statements and values are those of the source. It
/// refers to the text of `program`.
compiler::Program source_lines(const Program& program, const Code& code);

} // namespace orb::structured
