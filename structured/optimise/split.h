#pragma once

#include "structured/analyse/ranges.h"

namespace orb::structured {

/// Inlines subs whose calls with known values do little. Returns true if the program changed;
/// `ranges` is then outdated.
bool split_ways(Code& code, Ranges& ranges);

} // namespace orb::structured
