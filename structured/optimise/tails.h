#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Ways that do the same before they meet do it once: the lines of one go, and a jump leads it to
/// those of the other. True where there were any.
bool merge_tails(Code& code);

} // namespace orb::structured
