#pragma once

#include "bytecode/chunk.h"
#include "spec/basic.h"

#include <string_view>

namespace orb::compiler {

/// Parses and compiles the text of a program area, whatever it contains. The text ends at its first
/// NUL. A statement that is newer than the ball's language stops the program when it is reached:
/// with Unknown statement if its word was added later, else with Syntax error.
bytecode::Chunk load(std::string_view text,
                     spec::BasicVersion language = spec::default_basic_version);

} // namespace orb::compiler
