#include "bytecode/chunk.h"

namespace orb::bytecode {

std::optional<std::string> verify(const Chunk& chunk) {
  if (chunk.code.empty() || chunk.code.back().op != Op::EndOfProgram)
    return "the code does not end with EndOfProgram";
  return std::nullopt;
}

} // namespace orb::bytecode
