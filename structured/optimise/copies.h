#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Makes one variable of those that are copies of each other and never differ while both are
/// needed. True where there were any.
bool join_copies(Code& code);

} // namespace orb::structured
