#pragma once

#include "bytecode/chunk.h"
#include "compiler/text/program.h"

namespace orb::compiler {

/// Compiles a program to what the machine runs. Total: a line that did not parse becomes a trap
/// with the robot's error number, and so does a branch to a line that does not exist; each is met
/// only when it is reached. The result passes bytecode::verify().
bytecode::Chunk generate(const Program& program);

} // namespace orb::compiler
