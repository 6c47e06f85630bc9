#pragma once

#include "testing/suite.h"

#include <cstdint>
#include <string>

namespace orb::testing {

/// Where a line or a macro command stands, and what: `corner.bas:4: 40 goroll 90,100,1`; empty
/// where nothing ran.
std::string place_of(const Prepared& program, const Running& running);

/// The command that shows a case again: `orb run …`, or `orb test …` where the ball still rolled
/// after the end of the program (`rolls_out`), which `orb run` does not wait for.
std::string replay_command(const Suite& suite, const Group& group, std::uint64_t seed,
                           bool rolls_out);

} // namespace orb::testing
