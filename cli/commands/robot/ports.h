#pragma once

#include "cli/context/config.h"

#include <string>
#include <vector>

namespace orb::cli {

/// A device that could be a ball.
struct Port {
  std::string url;
  std::string what;
};

/// Named balls, then serial ports that may lead to a ball, by name.
std::vector<Port> find_ports(const Config& config);

} // namespace orb::cli
