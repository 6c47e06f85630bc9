#pragma once

#include <string>
#include <string_view>

namespace orb::structured {

/// The canonical layout of a structured program: two blanks for each block, words in their
/// documented spelling, names as they are first written, one blank around operators, comments kept,
/// blank lines at most one in a row. Formatting the result again changes nothing, nor does it
/// change what the program does. Lines that do not parse keep their tokens.
std::string format(std::string_view text);

} // namespace orb::structured
