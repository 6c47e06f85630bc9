#pragma once

#include "structured/lower/code.h"

#include <cstdint>
#include <span>
#include <vector>

namespace orb::structured {

/// Follows jumps to their final targets; removes unreachable lines, jumps to the next line and
/// unused labels. Preserves behaviour; returns true if the program changed.
bool clean_jumps(Code& code);

/// Moves lines that only jumps reach to one of those jumps. Returns true if there were any.
bool straighten(Code& code);

/// Of each line: the label of the innermost robot loop around it, or none.
std::vector<std::uint32_t> loops_of_lines(const Code& code);

/// Of each label: its line, or none.
std::vector<std::uint32_t> lines_of_labels(const Code& code);

/// Removes lines without effect and unused labels; returns the number of references to each label.
std::vector<std::uint32_t> tidy(Code& code);

} // namespace orb::structured
