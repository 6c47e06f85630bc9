#pragma once

#include "report/journey.h"

#include <span>
#include <string>

namespace orb::report {

/// Draws the path on a grid with a scale, each stretch in the colour of the LED, as an SVG that is
/// readable on light and dark pages. For a ball that stayed in place, a ring shows its colours
/// clockwise over time. `planned`, which may be null, is drawn pale behind it. The same journey
/// gives the same bytes.
std::string path_svg(const Journey& journey, const Journey* planned = nullptr);

/// Draws the paths of all balls of a room, each ball with its name and in its real size.
std::string room_svg(std::span<const RoomRun> balls);

} // namespace orb::report
