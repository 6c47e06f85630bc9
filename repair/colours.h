#pragma once

// Private to repair/.

#include "repair/tokens.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::repair {

/// A colour as FUNCTION of a template writes it: `rgb` its three values, `code` that of LEDC,
/// `testcolour` a word of a test file, anything else a word of structured programs.
std::optional<std::string> write_colour(std::string_view function, const Tokens& tokens);

} // namespace orb::repair
