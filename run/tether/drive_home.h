#pragma once

#include "run/tether/run_tethered.h"

#include <cstdint>
#include <tl/expected.hpp>

namespace orb::run {

/// Whether a robot is back where its last run began, facing as it did then.
enum class Home : std::uint8_t {
  Reached,
  Missed, ///< something stands in its way, or it was not there in time
};

/// Drives the robot slowly to the place that its last run began at and turns it to where it faced
/// then. However it ends, the robot has been told to stop.
tl::expected<Home, Failure> drive_home(protocol::Transport& transport, const TetherOptions& tether);

} // namespace orb::run
