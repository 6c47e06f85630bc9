#pragma once

#include "playground/engine/request.h"
#include "testing/results.h"
#include "testing/suite.h"

namespace orb::playground {

/// Reads the test files that a request names, with all that they name; fails if they have mistakes.
tl::expected<testing::Suite, Problem> read_suite(Request& request, structured::Files& files);
/// The results, with a text for people.
Answer results_of(const testing::Results& results, std::string_view text, Request& request);

/// Runs test files and judges them.
Answer test(Request& request);

/// Runs one case of a test again, with data for the player.
Answer replay(Request& request);

} // namespace orb::playground
