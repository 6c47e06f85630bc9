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

/// Gives the lines new numbers in the order of the text and follows every goto, gosub, on and
/// sleep. Refuses where a number could change its meaning: a line that does not parse, a jump to a
/// line that does not exist, a computed wake-up line, a number beyond 65535.
std::variant<std::string, Obstacle> renumber(const Program& program, Numbering numbering);

} // namespace orb::compiler
