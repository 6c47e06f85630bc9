#pragma once

#include "repair/tokens.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What people call operands, units and values: the rows ORB_CALLED of repair/idioms.def.

namespace orb::repair {

/// Whether people call an operand so: `velocidad` is `speed`.
bool is_called(std::string_view operand, std::string_view word);

/// All that a word is called in one of the languages: `cerca` is `near`.
std::vector<std::string_view> meanings_of(std::string_view word);

/// All words that an operand, a unit or a value is called.
std::vector<std::string_view> called_words();

/// Whether two words stand for the same operand, unit or value: `Richtung` and `direction`.
bool mean_the_same(std::string_view a, std::string_view b);

/// A colour as tests write it; nothing where the token is none.
std::optional<std::string> test_colour(const Token& token);

/// A small number, in digits or as a word: `three`, `drei`; 0 for others.
int count_of(const Token& token);

} // namespace orb::repair
