#pragma once

// Private to assembler/.

#include "repair/arrange.h"
#include "repair/repair.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::assembler {

/// What the rest of a file says.
struct Elsewhere {
  repair::Quantities constants;
  std::vector<std::string> macros; ///< by their names
  std::vector<std::string> names;  ///< of constants, whatever their values
};
Elsewhere look_elsewhere(std::string_view text);

/// A line as macros have it: without the signs of others, its command found by what people call it,
/// its operands in the order of the table, each in its unit. A wait that no operand takes is a line
/// of its own.
std::vector<repair::Rephrased> rephrase(const repair::Tokens& line, const Elsewhere& elsewhere);

} // namespace orb::assembler
