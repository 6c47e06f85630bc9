#pragma once

#include <string>
#include <string_view>

namespace orb::structured {

/// Formats a structured program: two spaces per block, words in their documented spelling, names as
/// first written, one space around operators, comments kept, at most one blank line in a row.
/// Formatting the result again changes nothing; the behaviour of the program stays the same. Lines
/// that do not parse keep their tokens.
std::string format(std::string_view text);

} // namespace orb::structured
