#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Replaces a variable that holds an unchanged element by reads of that element. Preserves
/// behaviour; returns true if the program changed.
bool use_elements(Code& code);

} // namespace orb::structured
