#pragma once

#include "run/tether/run_tethered.h"

#include <cstdint>
#include <tl/expected.hpp>

namespace orb::run {

/// Reached: the robot is back where its last run began, facing as it did then.
enum class Home : std::uint8_t {
  Reached,
  Missed, ///< something blocks the way, or time ran out
};

/// Drives the robot slowly to the place where its last run began and turns it to the direction it
/// faced then. Sends a stop whatever the result.
tl::expected<Home, Failure> drive_home(protocol::Transport& transport, const TetherOptions& tether);

} // namespace orb::run
