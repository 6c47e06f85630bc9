#pragma once

// Private to testing/.

#include "testing/suite.h"

namespace orb::testing {

/// Adds what is expected of the program of a file and can never come, by the look of its lines: a
/// text that it prints in other letters, a place with its coordinates exchanged. A program may
/// still be written, after its test: what is not there at all is not told.
void check_meant(SuiteFile& file, const Prepared& program);

} // namespace orb::testing
