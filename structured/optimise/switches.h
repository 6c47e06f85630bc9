#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Writes each remaining `select` as tests, placed before the lines they lead to.
void write_switches(Code& code);

} // namespace orb::structured
