#pragma once

#include "repair/tokens.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Common names of operands, units and values: the rows ORB_CALLED of repair/idioms.def.

namespace orb::repair {

/// True if a word is a common name of an operand: `velocidad` is `speed`.
bool is_called(std::string_view operand, std::string_view word);

/// All meanings of a word in any of the languages: `cerca` is `near`.
std::vector<std::string_view> meanings_of(std::string_view word);

/// All names of operands, units and values.
std::vector<std::string_view> called_words();

/// True if two words name the same operand, unit or value: `Richtung` and `direction`.
bool mean_the_same(std::string_view a, std::string_view b);

/// A colour in the notation of tests; nothing if the token is not a colour.
std::optional<std::string> test_colour(const Token& token);

/// Parses a small number, in digits or as a word: `three`, `drei`; 0 for anything else.
int count_of(const Token& token);

} // namespace orb::repair
