#pragma once

#include "structured/text/program.h"

namespace orb::structured {

/// Removes the warnings and notes allowed by comments such as `' orb: allow unused-name` on the
/// same line, or on the next one if the comment is alone on its line. Errors stay: they prevent
/// building.
void silence(Program& program);

} // namespace orb::structured
