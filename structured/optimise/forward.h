#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Moves what is computed into a variable to the one place that reads it, copies to where they come
/// from, and takes out assignments that nobody reads. What happens keeps its order. True where
/// something changed.
bool forward_values(Code& code);

} // namespace orb::structured
