#pragma once

// Private to repair/.

#include "repair/line.h"

#include <string_view>

namespace orb::repair {

/// True if statements can mean what the line says. A proposal that loses content is worse than
/// none.
bool keeps_meaning(const Line& line, std::string_view statements);

/// True if whole lines preserve the texts, functions, numbers and jumps of the line.
bool keeps_parts(const Line& line, std::string_view lines);

} // namespace orb::repair
