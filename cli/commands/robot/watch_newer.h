#pragma once

#include "cli/robot/reach.h"

#include <string_view>
#include <tl/expected.hpp>

namespace orb::cli {

/// Prints the sensors of a packets v2 robot until Ctrl-C, or for `lasts` if that is not 0: position
/// and attitude every second, collisions as they happen, the battery voltage. With the format
/// `json`, each is a line of JSON (docs/reference/json.md). Silences the robot again at the end.
tl::expected<void, Failure> watch_newer(const Context& context, Link& link, const Newer& newer,
                                        Duration lasts, std::string_view format);

} // namespace orb::cli
