#pragma once

#include "structured/text/program.h"

namespace orb::structured {

/// Leaves out the warnings and notes that comments such as `' orb: allow unused-name` allow on
/// their line, or on the next one where they stand alone. Errors stay: there is no program with
/// them.
void silence(Program& program);

} // namespace orb::structured
