#pragma once

#include "report/journey.h"

#include <string>

namespace orb::debug {

/// The path in characters: `S` where it began, `O` where the ball is, `.` its way, `#` walls. One
/// character is as many centimetres to the right as the last line says, and twice as many ahead.
std::string picture(const report::Journey& journey);

} // namespace orb::debug
