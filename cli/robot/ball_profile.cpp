#include "cli/robot/ball_profile.h"

#include "base/text/text.h"
#include "cli/context/save_ball.h"
#include "cli/model/command.h"
#include "disk/disk.h"

#include <fmt/format.h>

namespace orb::cli {

void add_ball_option(const Command& command, std::string& name, const std::string& help) {
  command.add_option("--ball", name, help).type_name("NAME");
}

tl::expected<std::string, Failure> profile_file(const std::string& name) {
  if (name.find_first_of("/\\") != name.npos || has_ending(name, ".toml"))
    return name;
  if (!is_ball_name(name))
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("`{}` is not a valid ball name: use letters, digits, - and _; or "
                            "a file such as ./red.toml",
                            name)});
  auto folder = settings_folder();
  if (!folder)
    return tl::unexpected(folder.error());
  return fmt::format("{}/balls/{}.toml", *folder, name);
}

tl::expected<run::Profile, Failure> read_profile(const std::string& name,
                                                 const std::string& robot) {
  const auto file = profile_file(name);
  if (!file)
    return tl::unexpected(file.error());
  const auto text = disk::read(*file);
  if (!text)
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("{}; `orb calibrate --port URL -o {}` creates it",
                                            text.error().message, name)});
  auto profile = run::parse_profile(*text);
  if (!profile)
    return tl::unexpected(
        Failure{ExitCode::BadInput, fmt::format("{}: {}", *file, profile.error())});
  if (!robot.empty() && spec::find_robot(robot)->robot != profile->robot)
    return tl::unexpected(
        Failure{ExitCode::Usage, fmt::format("the profile `{}` is for a {}; omit `--robot {}`",
                                             name, spec::info(profile->robot).title, robot)});
  return *profile;
}

} // namespace orb::cli
