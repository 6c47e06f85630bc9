#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Removes calls and assignments whose results are already in place: they ran on every path, and
/// since then nothing changed their inputs or results.
bool drop_repeated(Code& code);

} // namespace orb::structured
