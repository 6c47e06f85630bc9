#pragma once

#include "compiler/text/image.h"

#include <cstdint>
#include <string>

namespace orb::run {

/// How far a listing goes down.
enum class Listed : std::uint8_t {
  Instructions, ///< of bytecode/op.def
  MachineCode,  ///< these, and what the processor gets where this build has a back end
};

/// What the virtual ball makes of a program: each line as the robot has it, with its instructions.
std::string listing(const compiler::Image& image, Listed listed);

} // namespace orb::run
