#pragma once

#include "base/exit_code.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// Letters, digits, - and _.
bool is_ball_name(const std::string& name);

/// The folder of the user's settings; it need not be there. Fails where the user has none.
tl::expected<std::string, Failure> settings_folder();

/// Makes `@name` stand for `url` in the user's file; all else in it stays as it is. The file's
/// path.
tl::expected<std::string, Failure> save_ball(const std::string& name, const std::string& url);

} // namespace orb::cli
