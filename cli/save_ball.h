#pragma once

#include "base/exit_code.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// Makes `@name` stand for `url` in the user's file; all else in it stays as it is. The file's
/// path.
tl::expected<std::string, Failure> save_ball(const std::string& name, const std::string& url);

} // namespace orb::cli
