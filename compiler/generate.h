#pragma once

#include "bytecode/chunk.h"
#include "compiler/text/program.h"

namespace orb::compiler {

/// Compiles a program for the machine. Accepts every program: a line that did not parse becomes a
/// trap with the robot's error number, and so does a branch to a missing line; the trap fires only
/// if it is reached. The result passes bytecode::verify().
bytecode::Chunk generate(const Program& program);

} // namespace orb::compiler
