#pragma once

#include <cstdint>

namespace orb::bytecode {

enum class Op : std::uint16_t { EndOfProgram };

} // namespace orb::bytecode
