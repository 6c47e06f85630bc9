#pragma once

// Private to testing/.

#include "testing/suite.h"

namespace orb::testing {

/// Adds expectations that the program can evidently never meet: a text that it prints in other
/// letters, a place with its coordinates exchanged. Stays silent about what the program lacks
/// altogether: people also write tests first.
void check_meant(SuiteFile& file, const Prepared& program);

} // namespace orb::testing
