#pragma once

// Private to repair/.

#include "repair/idioms.h"

#include <string>
#include <vector>

namespace orb::repair {

/// What a line can only mean by its words, in whatever order and grammar they stand:
/// `setRoll(heading=90, speed=100)`, `turn the lamp blue`. The statements, the likeliest first; of
/// two that belong together, each on a line. Nothing where a word is left over.
std::vector<std::string> gist_of(const Tokens& line, const Surroundings& around);

} // namespace orb::repair
