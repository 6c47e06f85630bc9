#pragma once

#include "run/held_robot.h"
#include "run/tether/run_tethered.h"

#include <memory>
#include <tl/expected.hpp>

namespace orb::run {

/// Prepares the robot at the other end of `transport`, which must outlive it, and holds it.
tl::expected<std::unique_ptr<HeldRobot>, Failure> hold_robot(protocol::Transport& transport,
                                                             const TetherOptions& tether);

} // namespace orb::run
