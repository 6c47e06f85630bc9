#pragma once

// Private to repair/.

#include "repair/idioms.h"

#include <string>
#include <vector>

namespace orb::repair {

/// Guesses the statements that a line can only mean by its words, in any order and grammar:
/// `setRoll(heading=90, speed=100)`, `turn the lamp blue`. The likeliest come first; two that
/// belong together are on separate lines. Empty if a word remains unused.
std::vector<std::string> gist_of(const Tokens& line, const Surroundings& around);

} // namespace orb::repair
