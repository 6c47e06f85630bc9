#pragma once

// Private to repair/.

#include "repair/tokens.h"

#include <optional>
#include <string>

namespace orb::repair {

/// Converts print arguments of other languages to a list for `print`: adjacent texts, without `+`,
/// `str()` and formats.
std::optional<std::string> print_items(const Tokens& tokens);

/// Quotes unquoted words as a text.
std::optional<std::string> quoted(const Tokens& tokens);

} // namespace orb::repair
