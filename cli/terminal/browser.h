#pragma once

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// Shows the file at `path` in the user's browser. Tries the commands in $BROWSER (separated by
/// colons; `%s` is the file), then `xdg-open`, until one starts and does not fail within two
/// seconds. The browser runs detached from the terminal. The error names the file.
tl::expected<void, std::string> show_in_browser(const std::string& path);

} // namespace orb::cli
