#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Of two ways from a test that meet again, one that only sets a variable is gone before the test
/// where the other way does not miss it: `a = 1`, `if c then goto …` takes a jump less. What a
/// function mostly returns is set at its beginning. True where there were any.
bool hoist_arms(Code& code);

} // namespace orb::structured
