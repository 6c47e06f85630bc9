#pragma once

// Private to testing/.

#include "repair/repair.h"
#include "testing/text/filling.h"

#include <vector>

namespace orb::testing {

/// What a line says, in the documented form of the word whose slots take all of it.
std::vector<repair::Rephrased> documented_forms(const repair::Tokens& line,
                                                const Elsewhere& elsewhere);

} // namespace orb::testing
