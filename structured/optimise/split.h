#pragma once

#include "structured/analyse/ranges.h"

namespace orb::structured {

/// Does twice what is short where that does away with a test: lines before a test whose outcome is
/// known on each way that leads to them, and subs of which a call with known values does little.
/// True where something changed; then what was known no longer fits the lines.
bool split_ways(Code& code, Ranges& ranges);

} // namespace orb::structured
