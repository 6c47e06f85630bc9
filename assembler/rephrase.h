#pragma once

// Private to assembler/.

#include "repair/arrange.h"
#include "repair/repair.h"

#include <string_view>
#include <vector>

namespace orb::assembler {

/// The constants of a file.
repair::Quantities constants_of(std::string_view text);

/// A line with its operands in the order of the table, each in its unit; a wait that no operand
/// takes is a line of its own.
std::vector<repair::Rephrased> rephrase(const repair::Tokens& line,
                                        const repair::Quantities& constants);

/// The lines that wait so long, as a command; empty for what would be a page of them.
std::vector<std::int64_t> waits_of(std::int64_t ms);

} // namespace orb::assembler
