#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Makes each use of a name a variable of its own: the counters of two loops need not share what is
/// known of them, nor a letter. True where there were any.
bool split_variables(Code& code);

} // namespace orb::structured
