#pragma once

#include "compiler/text/image.h"

#include <cstdint>
#include <string>

namespace orb::run {

/// Depth of a listing.
enum class Listed : std::uint8_t {
  Instructions, ///< of bytecode/op.def
  MachineCode,  ///< also machine code, if this build has a back end
};

/// Returns a listing of a program as the virtual ball runs it: each robot line with its
/// instructions.
std::string listing(const compiler::Image& image, Listed listed);

} // namespace orb::run
