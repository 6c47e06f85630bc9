#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Inlines subs if that does not make the program longer: those called once, and those shorter than
/// their calls. Returns true if there were any.
bool inline_calls(Code& code);

} // namespace orb::structured
