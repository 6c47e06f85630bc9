#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Cuts prints that could exceed the robot's 32 bytes; the output stays the same. Side effects of
/// the items come before the first of them is sent.
void cut_prints(Code& code);

} // namespace orb::structured
