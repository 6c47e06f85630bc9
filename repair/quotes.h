#pragma once

// Private to repair/.

#include "repair/line.h"

#include <string>
#include <vector>

namespace orb::repair {

/// Repairs a `print` with an odd number of quotes by adding or removing one; the best variants
/// leave the fewest names of the program in texts. `print "toss, C ": " T` is `print "toss, C ": "
/// T`.
std::vector<std::string> with_one_quote(const Line& line);

/// Closes an open bracket: `if not (a = 1 then`, `goroll (H + 90 % 360, 80, 1`. Empty if none is
/// open.
std::string with_bracket(const Line& line);

} // namespace orb::repair
