#pragma once

#include "cli/commands/robot/ports.h"

#include <string_view>
#include <vector>

namespace orb::cli {

/// The devices of this computer that may be robots, by name.
std::vector<Port> find_devices();

/// What to do if there is none.
extern const std::string_view no_device_help;

} // namespace orb::cli
