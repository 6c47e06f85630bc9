#pragma once

#include "report/journey.h"

#include <string>

namespace orb::debug {

/// Draws the path in characters: `S` the start, `O` the ball, `.` its path, `#` walls. The last
/// line gives the width of a character in centimetres; it covers twice as much ahead.
std::string picture(const report::Journey& journey);

} // namespace orb::debug
