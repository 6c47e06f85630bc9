#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Drops calls that would compute, and assignments that would set, what is there already: it has
/// been done on every way, and nothing that it reads or gives has changed since.
bool drop_repeated(Code& code);

} // namespace orb::structured
