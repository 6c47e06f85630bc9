#pragma once

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// Shows the file at `path` in the user's browser: the first of the commands in $BROWSER (with
/// colons between them; `%s` stands for the file), then `xdg-open`, that starts and does not fail
/// within two seconds. It goes on by itself, without the terminal. Fails with a sentence that names
/// the file.
tl::expected<void, std::string> show_in_browser(const std::string& path);

} // namespace orb::cli
