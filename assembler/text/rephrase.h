#pragma once

// Private to assembler/.

#include "repair/arrange.h"
#include "repair/repair.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::assembler {

/// Names defined in the rest of a file.
struct SurroundingText {
  repair::Quantities constants;
  std::vector<std::string> macros; ///< names of macros
  std::vector<std::string> names;  ///< names of constants, whatever their values
};
SurroundingText read_surroundings(std::string_view text);

/// Rewrites a foreign line as macro source: strips foreign punctuation, finds the command by its
/// common names, puts the operands into table order and native units. A wait that no operand takes
/// becomes its own line.
std::vector<repair::Rephrased> rephrase(const repair::Tokens& line,
                                        const SurroundingText& elsewhere);

} // namespace orb::assembler
