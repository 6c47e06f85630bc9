#pragma once

#include "structured/analyse/ranges.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace orb::structured {

/// A line to insert before another one.
using AddedLine = std::pair<std::uint32_t, CodeLine>;

/// Jump threading: redirects edges past tests whose outcome is known on that edge, so a flag that
/// was just set and is then tested becomes the jump itself. Lines keep their positions; insertions
/// go to `added`. Returns true if the program changed.
bool thread_tests(Code& code, Ranges& ranges, std::vector<AddedLine>& added);

} // namespace orb::structured
