#pragma once

// Private to testing/.

#include "base/source.h"
#include "testing/text/test_file.h"

#include <string>
#include <vector>

namespace orb::testing {

/// What can be read, and can hardly be meant: what holds from the start, what contradicts itself,
/// what comes after the end of the run.
std::vector<Diagnostic> find_doubts(const Source& source, const TestFile& file);

} // namespace orb::testing
