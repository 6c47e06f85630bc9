#pragma once

// Private to assembler/.

#include "repair/arrange.h"
#include "repair/repair.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::assembler {

/// What the rest of a file says.
struct Elsewhere {
  repair::Quantities constants;
  std::map<std::string, std::string, std::less<>> times; ///< the last one of each command
  std::vector<std::string> macros;                       ///< by their names, from the top
  std::set<std::string, std::less<>> named;              ///< all words behind commands
};
Elsewhere look_elsewhere(std::string_view text);

/// A line with its operands in the order of the table, each in its unit; a wait that no operand
/// takes is a line of its own.
std::vector<repair::Rephrased> rephrase(const repair::Tokens& line, const Elsewhere& elsewhere);

/// The lines that wait so long, as a command; empty for what would be a page of them.
std::vector<std::int64_t> waits_of(std::int64_t ms);

} // namespace orb::assembler
