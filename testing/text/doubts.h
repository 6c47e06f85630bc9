#pragma once

// Private to testing/.

#include "base/source.h"
#include "testing/text/test_file.h"

#include <string>
#include <vector>

namespace orb::testing {

/// Finds valid lines that are probably not intended: true from the start, contradictory, or after
/// the end of the run.
std::vector<Diagnostic> find_doubts(const Source& source, const TestFile& file);

} // namespace orb::testing
