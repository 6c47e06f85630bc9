#pragma once

#include "playground/engine/request.h"
#include "testing/results.h"
#include "testing/suite.h"

namespace orb::playground {

/// Reads the test files that a request names, with all that they name; fails if they have mistakes.
tl::expected<testing::Suite, Problem> read_suite(Request& request, structured::Files& files);
/// The results as JSON, and as the text that `format` asks for: `text` if it is absent, `junit`, or
/// none for `json`.
Answer results_of(const testing::Results& results, Request& request);

/// Runs test files and judges them.
Answer test(Request& request);

/// Runs one case of a test again, with data for the player.
Answer replay(Request& request);

} // namespace orb::playground
