#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Whether a sub that only computes is called more than once.
bool calls_repeat(Code& code);

/// Drops calls that would compute, and assignments that would set, what is there already: it has
/// been done on every way, and nothing that it reads or gives has changed since. What another
/// variable has been set to is read from it.
bool drop_repeated(Code& code);

} // namespace orb::structured
