#pragma once

#include "compiler/text/program.h"

#include <cstdint>
#include <string>
#include <variant>

namespace orb::compiler {

struct Numbering {
  std::uint32_t start = 10;
  std::uint32_t step = 10;
};

/// Why a program cannot be renumbered.
struct Obstacle {
  Span span;
  std::string message;
};

/// Renumbers the lines in text order and updates every goto, gosub, on and sleep. Fails if a number
/// could change its meaning: on a line that does not parse, a jump to a missing line, a computed
/// wake-up line, or a number beyond 65535.
std::variant<std::string, Obstacle> renumber(const Program& program, Numbering numbering);

} // namespace orb::compiler
