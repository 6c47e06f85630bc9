#pragma once

// Private to repair/.

#include "repair/tokens.h"

#include <optional>
#include <string>

namespace orb::repair {

/// `"### is missing"` with the value in the place of its signs.
std::optional<std::string> print_using(const Tokens& format, const Tokens& values);

/// What other languages print, as a list for `print`: texts side by side, without `+`, `str()` and
/// formats.
std::optional<std::string> print_items(const Tokens& tokens);

/// Words that stand without quotes, as a text.
std::optional<std::string> quoted(const Tokens& tokens);

} // namespace orb::repair
