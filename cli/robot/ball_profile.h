#pragma once

#include "base/exit_code.h"
#include "run/calibrate/profile.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

class Command;

/// Adds `--ball NAME`: how a virtual ball drives.
void add_ball_option(const Command& command, std::string& name, const std::string& help);

/// The file of a profile: `balls/NAME.toml` next to the user's settings, or `name` itself if it is
/// a path. Fails for other names, and if the user has no place for settings.
tl::expected<std::string, Failure> profile_file(const std::string& name);

/// Reads a profile. `robot` comes from the command line; empty for any.
tl::expected<run::Profile, Failure> read_profile(const std::string& name, const std::string& robot);

} // namespace orb::cli
