#pragma once

#include "testing/lookup.h"

namespace orb::testing {

// Seldom called: functions of their own, so that the playground can load them later.

/// Reports the lines of a file about `program`, which is JavaScript, that only a program on the
/// robot can meet, but not those about what is expected.
[[gnu::noinline]] void check_javascript(SuiteFile& file, std::string_view program);
/// Where a JavaScript program can be tested, as a line.
[[gnu::noinline]] std::string where_tested(std::string_view program, const Say& say);
/// Refuses what cannot be expected of a JavaScript program; returns false for all else.
[[gnu::noinline]] bool refuse_of_robot(const Expectation& one, const Prepared& program,
                                       Lookup& found);
/// Reports a JavaScript program in a room.
[[gnu::noinline]] void refuse_in_room(SuiteFile& file, const TestBall& ball);

} // namespace orb::testing
