#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Cuts prints that could pass the robot's 32 bytes; the same bytes arrive. What the items do
/// besides giving a value happens before the first of them leaves.
void cut_prints(Code& code);

} // namespace orb::structured
