#pragma once

#include "repair/tokens.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// A line that small changes make of another.
struct Candidate {
  std::string text;
  int cost = 0; ///< in tenths of a changed token; a slip of the hand is below 10
};

/// What one change makes of a line, the cheapest first: a word that is near another one, words
/// joined and split, a sign too much, too few or another one, neighbours swapped. Never a number
/// that was not written, and none left out. `names` are words of the text itself.
std::vector<Candidate> changes(const Tokens& line, Language language,
                               std::span<const std::string_view> words,
                               std::span<const std::string_view> names);

} // namespace orb::repair
