#pragma once

#include "cli/commands/robot/ports.h"

#include <vector>

namespace orb::cli {

/// The devices of this computer that may be robots, by their names.
std::vector<Port> find_devices();

} // namespace orb::cli
