#pragma once

#include "bytecode/chunk.h"
#include "spec/basic.h"

#include <string_view>

namespace orb::compiler {

/// What a ball does with the text of a program area: parses and compiles it, whatever it is. The
/// text ends at its first NUL. A statement of a later language than the ball's stops the program
/// where it is reached: with Unknown statement where its word came later, else with Syntax error
///
bytecode::Chunk load(std::string_view text,
                     spec::BasicVersion language = spec::default_basic_version);

} // namespace orb::compiler
