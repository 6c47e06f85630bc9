#pragma once

#include "structured/analyse/ranges.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace orb::structured {

/// A line to put before another one.
using AddedLine = std::pair<std::uint32_t, CodeLine>;

/// Leads ways past tests whose outcome is known on that way: a flag that has just been set and is
/// tested next becomes the jump itself. Lines keep their places; what is to be added between them
/// is added to `added`. True where something changed.
bool thread_tests(Code& code, Ranges& ranges, std::vector<AddedLine>& added);

} // namespace orb::structured
