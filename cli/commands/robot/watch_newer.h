#pragma once

#include "cli/robot/reach.h"

#include <string_view>
#include <tl/expected.hpp>

namespace orb::cli {

/// Prints what a robot of packets v2 feels until Ctrl-C or for `lasts`, where that is not 0: where
/// it is and how it lies every second, its collisions as they come, the voltage of its battery.
/// With the format `json` each is a line of JSON (docs/json.md). The robot is silent again
/// afterwards.
tl::expected<void, Failure> watch_newer(const Context& context, Link& link, const Newer& newer,
                                        Duration lasts, std::string_view format);

} // namespace orb::cli
