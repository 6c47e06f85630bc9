#pragma once

#include "testing/suite.h"

namespace orb::testing {

/// Tells of the balls of a room whose programs are not there, or who start inside each other or in
/// a wall of the course, which has been read. Of the first ball's program the suite tells itself.
void check_room(SuiteFile& file, structured::Files& files);

} // namespace orb::testing
