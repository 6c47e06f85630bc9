#pragma once

#include "run/tether/wire.h"

#include <memory>

namespace orb::run {

/// Makes the wire for API v1.
std::unique_ptr<RobotWire> make_wire_v1(spec::Robot robot, CollisionLimits limits);

} // namespace orb::run
