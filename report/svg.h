#pragma once

#include "report/journey.h"

#include <span>
#include <string>

namespace orb::report {

/// The path on a grid with a scale, each stretch in the colour that the LED showed, as an SVG that
/// is readable on light and dark pages. A ball that stayed where it was is drawn with its colours
/// round it, clockwise from the start to the end. The same journey makes the same bytes. The path
/// of `planned`, which may be null, lies pale behind it.
std::string path_svg(const Journey& journey, const Journey* planned = nullptr);

/// The paths of all balls of a room, each ball with its name and as large as it is.
std::string room_svg(std::span<const RoomRun> balls);

} // namespace orb::report
