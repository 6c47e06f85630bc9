#pragma once

#include "repair/candidate.h"
#include "repair/tokens.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// What one change makes of a line, the cheapest first: a word that is near another one, words
/// joined and split, a sign too much, too few or another one, neighbours swapped. Never a number
/// that was not written, and none left out. `names` are words of the text itself.
std::vector<Candidate> changes(const Tokens& line, Language language,
                               std::span<const std::string_view> words,
                               std::span<const std::string_view> names);

} // namespace orb::repair
