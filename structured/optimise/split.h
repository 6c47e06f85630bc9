#pragma once

#include "structured/analyse/ranges.h"

namespace orb::structured {

/// Writes subs out of which a call with known values does little. True where something changed;
/// then what was known no longer fits the lines.
bool split_ways(Code& code, Ranges& ranges);

} // namespace orb::structured
