#pragma once

#include "structured/lower/code.h"

#include <cstdint>
#include <span>
#include <vector>

namespace orb::structured {

/// Leads jumps to jumps where they end, takes out lines that nothing reaches, jumps to the next
/// line and labels that nothing names. Keeps what the program does. True where something changed.
bool clean_jumps(Code& code);

/// Puts lines that only jumps lead to where one of those jumps stands. True where there were any.
bool straighten(Code& code);

/// Of each line: the label of the innermost loop of the robot that it stands in, or none.
std::vector<std::uint32_t> loops_of_lines(const Code& code);

/// Of each label: its line, or none.
std::vector<std::uint32_t> lines_of_labels(const Code& code);

/// Takes out lines that do nothing and labels that nothing names; the same.
std::vector<std::uint32_t> tidy(Code& code);

} // namespace orb::structured
