#include "cli/context/config.h"

#include "base/text/text.h"
#include "cli/context/config_file.h"
#include "cli/context/context.h"
#include "cli/context/user.h"
#include "cli/model/checks.h"
#include "cli/model/command.h"
#include "disk/disk.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view project_file = "orb.toml";

/// The options that a project's file may set. Somebody else may have written it, so it cannot
/// choose outputs or write anything.
// clang-format off
constexpr auto project_options = std::to_array<std::string_view>({
    "target", "ram", "area", "executive", "firmware",                                     // the ball
    "deny", "warn", "allow", "max-errors",                                                // the rules' levels
    "pack", "fold-delays", "renumber",                                                    // layout
    "stale", "collision-threshold",                                                       // driven robots
    "for", "lines-per-second", "seed", "speed", "timeout", "connect-timeout", "attempts", "jobs", "tries", // budgets
});
// clang-format on

/// Looks in each folder upwards, as far as the root of the repository or the user's home.
std::optional<fs::path> nearest_project_file() {
  std::error_code error;
  const auto home = user_home();
  for (auto folder = fs::current_path(error); !folder.empty(); folder = folder.parent_path()) {
    const auto file = folder / project_file;
    if (fs::is_regular_file(file, error)) {
      if (is_trusted(file))
        return file;
      print_err(fmt::format("orb: warning: {} belongs to another user and is ignored\n",
                            file.generic_string()));
      break;
    }
    const bool at_home = home && fs::equivalent(folder, *home, error);
    if (at_home || fs::exists(folder / ".git", error) || folder == folder.root_path())
      break;
  }
  return std::nullopt;
}

/// The commands that a setting of section `command` applies to.
std::vector<Command> addressed(const Command& orb, const std::string& command) {
  auto all = orb.commands();
  if (!command.empty())
    std::erase_if(all, [&](const Command& one) { return one.name() != command; });
  return all;
}

tl::expected<void, ConfigError> apply(const Setting& setting, const Command& orb) {
  const auto commands = addressed(orb, setting.section.name);
  if (commands.empty()) {
    std::vector<std::string> names = {std::string(balls_section), std::string(groups_section)};
    for (const auto& command : addressed(orb, ""))
      names.push_back(command.name());
    return tl::unexpected(problem(setting.section.place,
                                  fmt::format("`[{}]` is not a section{}", setting.section.name,
                                              meant_instead(setting.section.name, names))));
  }
  const bool allowed = disk::as_path(setting.file).filename() != project_file ||
                       std::find(project_options.begin(), project_options.end(), setting.option) !=
                           project_options.end();
  bool known = false;
  std::vector<std::string> names;
  for (const auto& command : commands) {
    for (auto& name : command.option_names())
      names.push_back(std::move(name));
    const auto option = command.find("--" + setting.option);
    if (!option)
      continue;
    known = true;
    if (!allowed)
      break;
    if (auto why = option->set_default(setting.values))
      return tl::unexpected(problem(setting.place, *why));
  }
  if (!known)
    return tl::unexpected(problem(
        setting.place,
        fmt::format("`{}` is not an option{}{}", setting.option,
                    setting.section.name.empty() ? "" : " of `orb " + setting.section.name + "`",
                    meant_instead(setting.option, names))));
  if (!allowed)
    return tl::unexpected(
        problem(setting.place,
                fmt::format("a project file cannot set `{0}`; write `--{0}` on the command line, "
                            "or `{0}` in {1}",
                            setting.option, user_file().value_or("config.toml").generic_string())));
  return {};
}

} // namespace

tl::expected<Config, ConfigError> load_config() {
  Config config;
  std::error_code error;
  if (const auto user = user_file(); user && fs::is_regular_file(*user, error))
    if (auto done = read_into(config, *user); !done)
      return tl::unexpected(done.error());
  if (const auto project = nearest_project_file())
    if (auto done = read_into(config, *project); !done)
      return tl::unexpected(done.error());
  return config;
}

tl::expected<Config, ConfigError> read_roster(const std::string& file) {
  Config config;
  if (auto done = read_into(config, file); !done)
    return tl::unexpected(done.error());
  if (!config.settings.empty())
    return tl::unexpected(problem(
        config.settings.front().section.place.empty() ? config.settings.front().place
                                                      : config.settings.front().section.place,
        "a file of robots has the sections `[balls]` and `[groups]`; settings belong in orb.toml"));
  if (config.balls.empty())
    return tl::unexpected(
        problem(file, "there are no robots in this file; write `[balls]` and under it a "
                      "line such as `red = \"ble://SK-1A2B\"`"));
  return config;
}

tl::expected<void, ConfigError> apply_config(const Config& config, const Command& orb) {
  for (const auto& setting : config.settings)
    if (auto done = apply(setting, orb); !done)
      return done;
  return {};
}

std::string unknown_ball(const std::string& name, const std::vector<std::string>& names) {
  return fmt::format("unknown ball `{}`{}", name,
                     names.empty()
                         ? fmt::format("; `orb ports --save {}=URL` gives one that name", name)
                         : meant_instead(name, names));
}

tl::expected<std::string, ConfigError> resolve_port(const Config& config, const std::string& port) {
  if (!port.starts_with("@"))
    return port;
  const auto name = port.substr(1);
  if (const auto ball = config.balls.find(name); ball != config.balls.end())
    return ball->second.url;
  if (const auto group = config.groups.find(name); group != config.groups.end())
    return tl::unexpected(
        ConfigError{fmt::format("`@{}` is a group; write the name of one ball, such as `@{}`", name,
                                group->second.members.front().name)});
  return tl::unexpected(ConfigError{unknown_ball(name, names_in(config.balls))});
}

} // namespace orb::cli
