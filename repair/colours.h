#pragma once

// Private to repair/.

#include "repair/tokens.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::repair {

/// Prints a colour for FUNCTION of a template: `rgb` its three values, `code` its number in LEDC,
/// `testcolour` a word of a test file, anything else a word of structured programs.
std::optional<std::string> write_colour(std::string_view function, const Tokens& tokens);

} // namespace orb::repair
