#pragma once

// Private to repair/.

#include "repair/line.h"

#include <string>
#include <vector>

namespace orb::repair {

/// A `print` with an odd number of quotes, with one more or less: the best places, which leave the
/// fewest names of the program in texts. `print "toss, C ": " T` is `print "toss, C ": " T`.
std::vector<std::string> with_one_quote(const Line& line);

/// A bracket that is not closed: `if not (a = 1 then`, `goroll (H + 90 % 360, 80, 1`. Empty where
/// it is.
std::string with_bracket(const Line& line);

} // namespace orb::repair
