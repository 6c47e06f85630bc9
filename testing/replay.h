#pragma once

#include "testing/suite.h"

#include <cstdint>
#include <string>

namespace orb::testing {

/// The line or macro command that ran, with its text: `corner.bas:4: 40 goroll 90,100,1`. Empty if
/// nothing ran.
std::string place_of(const Prepared& program, const Running& running);

/// The command that shows a case again: `orb run …`. It is `orb test …` in a room, and if the ball
/// still rolled after the end of the program (`rolls_out`): `orb run` does not wait for that.
std::string replay_command(const Suite& suite, const Group& group, std::uint64_t seed,
                           bool rolls_out = false);

} // namespace orb::testing
