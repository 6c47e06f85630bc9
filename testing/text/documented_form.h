#pragma once

// Private to testing/.

#include "repair/repair.h"
#include "testing/text/filling.h"

#include <vector>

namespace orb::testing {

/// Rewrites a line in the documented form of each word whose slots take all of it.
std::vector<repair::Rephrased> documented_forms(const repair::Tokens& line,
                                                const SurroundingText& elsewhere);

} // namespace orb::testing
