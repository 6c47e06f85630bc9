#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Writes what is left of `select` as tests, each before the lines it leads to.
void write_switches(Code& code);

} // namespace orb::structured
