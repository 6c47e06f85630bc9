#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Splits each variable into independent ones: the counters of two loops need not share ranges or a
/// letter. Returns true if there were any.
bool split_variables(Code& code);

} // namespace orb::structured
