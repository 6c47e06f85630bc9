#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Writes subs in place of their calls where that makes the program no longer: those that are
/// called in one place, and those that are shorter than their calls. True where there were any.
bool inline_calls(Code& code);

} // namespace orb::structured
