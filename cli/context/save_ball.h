#pragma once

#include "base/exit_code.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// True for letters, digits, - and _.
bool is_ball_name(const std::string& name);

/// The folder of the user's settings; it may not exist yet. Fails if the user has no home for it.
tl::expected<std::string, Failure> settings_folder();

/// Sets `@name` to `url` in the user's file and keeps the rest. Returns the path of the file.
tl::expected<std::string, Failure> save_ball(const std::string& name, const std::string& url);

} // namespace orb::cli
