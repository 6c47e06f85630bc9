#pragma once

#include "repair/candidate.h"
#include "repair/tokens.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// Makes single changes to a line, the cheapest first: a similar word, words joined or split, a
/// sign added, removed or replaced, neighbours swapped. Never adds or drops a number. `names` are
/// words of the text itself.
std::vector<Candidate> changes(const Tokens& line, Language language,
                               std::span<const std::string_view> words,
                               std::span<const std::string_view> names);

} // namespace orb::repair
