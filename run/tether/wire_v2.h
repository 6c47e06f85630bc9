#pragma once

#include "run/tether/wire.h"

#include <memory>

namespace orb::run {

/// Packets v2, as that robot takes them.
std::unique_ptr<RobotWire> make_wire_v2(spec::Robot robot, CollisionLimits limits);

} // namespace orb::run
