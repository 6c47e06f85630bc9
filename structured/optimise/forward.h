#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Moves a value to the only place that reads it, replaces copies by their originals, and removes
/// dead assignments. Side effects keep their order. Returns true if the program changed.
bool forward_values(Code& code);

} // namespace orb::structured
