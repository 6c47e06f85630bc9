#pragma once

#include "testing/suite.h"

namespace orb::testing {

/// Reports balls of a room whose programs are missing, and balls that start inside each other or in
/// a wall of the course. Call it after the course is read. The suite itself reports the first
/// ball's program.
void check_room(SuiteFile& file, structured::Files& files);

} // namespace orb::testing
