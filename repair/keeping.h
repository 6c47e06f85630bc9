#pragma once

// Private to repair/.

#include "repair/line.h"

#include <string_view>

namespace orb::repair {

/// Whether a statement, or several, can mean what the line says: an offer that loses what was said
/// is worse than none.
bool keeps_meaning(const Line& line, std::string_view statements);

/// Whether whole lines still have the texts, functions, numbers and jumps of the line.
bool keeps_parts(const Line& line, std::string_view lines);

} // namespace orb::repair
