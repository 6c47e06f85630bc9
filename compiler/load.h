#pragma once

#include "bytecode/chunk.h"

#include <string_view>

namespace orb::compiler {

/// What a ball does with the text of a program area: parses and compiles it, whatever it is. The
/// text ends at its first NUL.
bytecode::Chunk load(std::string_view text);

} // namespace orb::compiler
