#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Reads elements where they are needed instead of from a variable that holds one while it does not
/// change. Keeps what the program does. True where something changed.
bool use_elements(Code& code);

} // namespace orb::structured
