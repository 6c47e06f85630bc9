#pragma once

#include "run/tether/wire.h"

#include <memory>

namespace orb::run {

/// Makes the wire for packets v2, in the dialect of this robot.
std::unique_ptr<RobotWire> make_wire_v2(spec::Robot robot, CollisionLimits limits);

/// Sets lamps of a robot of packets v2: a value for each bit of the mask, from the lowest.
Request lamps_request(const spec::RobotInfo& robot, std::uint32_t mask, const Bytes& values);

} // namespace orb::run
