#include "cli/config.h"

#include "base/text.h"
#include "cli/context.h"
#include "cli/model/command.h"
#include "cli/save_ball.h"
#include "disk/disk.h"
#include "disk/lock.h"
#include "spec/robots.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <sys/stat.h>
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>
#include <unistd.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view project_file = "orb.toml";
constexpr std::string_view balls_section = "balls";
constexpr std::string_view groups_section = "groups";

std::optional<fs::path> user_file() {
  if (const char* xdg = std::getenv("XDG_CONFIG_HOME"); xdg != nullptr && *xdg != '\0')
    return fs::path(xdg) / "orb" / "config.toml";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".config" / "orb" / "config.toml";
  return std::nullopt;
}

/// What a project's file may set: it comes with what somebody else has written. No output, and
/// nothing that writes.
// clang-format off
constexpr auto project_options = std::to_array<std::string_view>({
    "target", "ram", "area", "executive", "firmware",                                     // the ball
    "deny", "warn", "allow", "max-errors",                                                // the rules' levels
    "pack", "fold-delays", "renumber",                                                    // layout
    "for", "lines-per-second", "seed", "speed", "timeout", "connect-timeout", "attempts", // budgets
});
// clang-format on

/// Whether the file is the user's or root's: what somebody else has put into a folder above is not
/// obeyed. Root in the user's name (sudo) takes what is the user's.
bool is_trusted(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return false;
  const char* sudo = std::getenv("SUDO_UID");
  const bool sudoed = ::geteuid() == 0 && sudo != nullptr && std::to_string(status.st_uid) == sudo;
  return status.st_uid == ::geteuid() || status.st_uid == 0 || sudoed;
}

/// Found by walking up to the root of the repository or to the user's home.
std::optional<fs::path> nearest_project_file() {
  std::error_code error;
  const char* home = std::getenv("HOME");
  for (auto folder = fs::current_path(error); !folder.empty(); folder = folder.parent_path()) {
    const auto file = folder / project_file;
    if (fs::is_regular_file(file, error)) {
      if (is_trusted(file))
        return file;
      print_err(
          fmt::format("orb: warning: {} belongs to another user and is not read\n", file.string()));
      break;
    }
    const bool at_home = home != nullptr && fs::equivalent(folder, home, error);
    if (at_home || fs::exists(folder / ".git", error) || folder == folder.root_path())
      break;
  }
  return std::nullopt;
}

ConfigError problem(const std::string& where, std::string_view what) {
  return {fmt::format("{}: {}", where, what)};
}

std::string place_in(const std::string& file, const toml::source_position& at) {
  return fmt::format("{}:{}:{}", file, at.line, at.column);
}

std::string place_in(const std::string& file, const toml::node& node) {
  return place_in(file, node.source().begin);
}

/// The words of one value, as if they stood on the command line; nothing for what cannot.
std::optional<std::string> words_of(const toml::node& value) {
  if (const auto* text = value.as_string())
    return text->get();
  if (const auto* number = value.as_integer())
    return fmt::format("{}", number->get());
  if (const auto* number = value.as_floating_point())
    return fmt::format("{}", number->get());
  if (const auto* flag = value.as_boolean())
    return flag->get() ? "true" : "false";
  return std::nullopt;
}

tl::expected<std::vector<std::string>, ConfigError>
values_of(const std::string& file, std::string_view name, const toml::node& node) {
  std::vector<std::string> values;
  const auto wrong = [&](const toml::node& value) {
    return tl::unexpected(
        problem(place_in(file, value),
                fmt::format("`{}` takes texts, numbers, true or false, or a list of them", name)));
  };
  if (const auto* list = node.as_array()) {
    for (const auto& value : *list) {
      auto words = words_of(value);
      if (!words)
        return wrong(value);
      values.push_back(*std::move(words));
    }
    return values;
  }
  auto words = words_of(node);
  if (!words)
    return wrong(node);
  values.push_back(*std::move(words));
  return values;
}

tl::unexpected<ConfigError> refuse(const std::string& file, const toml::node& node,
                                   std::string_view what) {
  return tl::unexpected(problem(place_in(file, node), what));
}

/// `{ port = "URL", robot = "bolt" }`.
tl::expected<KnownBall, ConfigError> ball_of(const std::string& file, std::string_view name,
                                             const toml::table& table) {
  KnownBall ball;
  const std::vector<std::string> keys = {"port", "robot"};
  for (const auto& [key, node] : table) {
    const auto* text = node.as_string();
    if (key != keys[0] && key != keys[1])
      return tl::unexpected(
          problem(place_in(file, key.source().begin),
                  fmt::format("ball `{}` has a `port` and a `robot`, no `{}`{}", name, key.str(),
                              meant_instead(std::string(key.str()), keys))));
    if (text == nullptr)
      return refuse(file, node,
                    fmt::format("`{}` of ball `{}` is a text in quotes", key.str(), name));
    (key == keys[0] ? ball.url : ball.robot) = text->get();
    if (key == keys[1] && spec::find_robot(ball.robot) == nullptr)
      return refuse(file, node,
                    fmt::format("`{}` is not a robot{}", ball.robot,
                                meant_instead(ball.robot, names_of(spec::robots))));
  }
  if (ball.url.empty())
    return refuse(file, table,
                  fmt::format("ball `{}` has no port; write `{}`", name,
                              R"({ port = "ble://SB-1A2B", robot = "bolt" })"));
  return ball;
}

tl::expected<void, ConfigError> take_balls(Config& config, const std::string& file,
                                           const toml::table& section) {
  for (const auto& [name, node] : section) {
    KnownBall ball;
    if (const auto* url = node.as_string()) {
      ball.url = url->get();
    } else if (const auto* table = node.as_table()) {
      auto read = ball_of(file, name.str(), *table);
      if (!read)
        return tl::unexpected(read.error());
      ball = *std::move(read);
    } else {
      return refuse(file, node,
                    fmt::format("ball `{}` takes one URL, such as \"rfcomm://68:86:E7:00:11:22\"",
                                name.str()));
    }
    ball.line = name.source().begin.line;
    ball.place = place_in(file, name.source().begin);
    config.balls[std::string(name.str())] = std::move(ball);
  }
  return {};
}

tl::expected<void, ConfigError> take_groups(Config& config, const std::string& file,
                                            const toml::table& section) {
  for (const auto& [name, node] : section) {
    const auto* list = node.as_array();
    const auto example = fmt::format("`{} = [\"red\", \"blue\"]`", name.str());
    if (list == nullptr)
      return refuse(file, node,
                    fmt::format("the group `{}` is a list of balls: {}", name.str(), example));
    if (list->empty())
      return refuse(file, node,
                    fmt::format("the group `{}` is empty; write {}", name.str(), example));
    Group group;
    group.place = place_in(file, name.source().begin);
    for (const auto& member : *list) {
      const auto* text = member.as_string();
      if (text == nullptr)
        return refuse(file, member,
                      fmt::format("the group `{}` is a list of names: {}", name.str(), example));
      group.members.push_back({text->get(), place_in(file, member)});
    }
    config.groups[std::string(name.str())] = std::move(group);
  }
  return {};
}

tl::expected<void, ConfigError> take_setting(Config& config, const std::string& file,
                                             const Section& section, const toml::key& name,
                                             const toml::node& node) {
  if (node.is_table() || node.is_array_of_tables())
    return tl::unexpected(problem(
        place_in(file, node), fmt::format("`[{}.{}]` is nested too deep; sections are `[balls]` or "
                                          "a command such as `[check]`",
                                          section.name, name.str())));
  auto values = values_of(file, name.str(), node);
  if (!values)
    return tl::unexpected(values.error());
  config.settings.push_back({file, place_in(file, name.source().begin), section,
                             std::string(name.str()), *std::move(values)});
  return {};
}

} // namespace

std::string toml_words(std::string_view description) {
  if (const auto colon = description.find(": ");
      description.starts_with("Error while") && colon != description.npos)
    description.remove_prefix(colon + 2);
  std::string text(description);
  if (!text.empty())
    text.front() = to_lower(text.front());
  return text;
}

namespace {

/// A value that is no TOML, mostly because it stands without quotes: `for = 60s`.
std::string quotes_help(const std::string& text, std::uint32_t number) {
  std::istringstream stream(text);
  std::string line;
  for (std::uint32_t i = 0; i < number && std::getline(stream, line); ++i)
    ;
  const auto equals = line.find('=');
  const auto value =
      equals == line.npos ? std::string_view() : trim(std::string_view(line).substr(equals + 1));
  if (value.empty() || value.find_first_of("\"'[]{}#\\\r") != value.npos)
    return {};
  return fmt::format("; a text stands in quotes: `{} = \"{}\"`", trim(line.substr(0, equals)),
                     value);
}

tl::expected<void, ConfigError> read_text_into(Config& config, const std::string& file,
                                               const std::string& text) {
  const auto parsed = toml::parse(text, file);
  if (!parsed) {
    const auto& error = parsed.error();
    constexpr std::string_view twice = "cannot redefine existing string '";
    if (const auto at = error.description().find(twice); at != std::string_view::npos) {
      auto name = error.description().substr(at + twice.size());
      name = name.substr(0, name.find('\''));
      return tl::unexpected(problem(place_in(file, error.source().begin),
                                    fmt::format("`{}` stands twice; give one of them another name, "
                                                "or delete it",
                                                name)));
    }
    return tl::unexpected(problem(place_in(file, error.source().begin),
                                  fmt::format("not TOML: {}{}", toml_words(error.description()),
                                              quotes_help(text, error.source().begin.line))));
  }
  for (const auto& [key, node] : parsed.table()) {
    const auto name = std::string(key.str());
    const auto* section = node.as_table();
    if (section == nullptr) {
      if (name == balls_section || name == groups_section || node.is_array_of_tables())
        return tl::unexpected(
            problem(place_in(file, key.source().begin),
                    fmt::format("`{0}` is a section; write `[{0}]` on a line of its own", name)));
      if (auto taken = take_setting(config, file, {}, key, node); !taken)
        return taken;
    } else if (name == balls_section) {
      if (auto taken = take_balls(config, file, *section); !taken)
        return taken;
    } else if (name == groups_section) {
      if (auto taken = take_groups(config, file, *section); !taken)
        return taken;
    } else {
      const Section command{name, place_in(file, key.source().begin)};
      for (const auto& [option, value] : *section)
        if (auto taken = take_setting(config, file, command, option, value); !taken)
          return taken;
    }
  }
  return {};
}

tl::expected<void, ConfigError> read_into(Config& config, const fs::path& path) {
  const auto text = disk::read(path.string());
  if (!text)
    return tl::unexpected(ConfigError{text.error().message});
  return read_text_into(config, path.string(), *text);
}

/// The commands that a setting of section `command` speaks to.
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
  const bool allowed = fs::path(setting.file).filename() != project_file ||
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
                fmt::format("a project's file cannot set `{0}`; write `--{0}` on the command line, "
                            "or `{0}` in {1}",
                            setting.option, user_file().value_or("config.toml").string())));
  return {};
}

/// A line without what stands around it.
std::string_view trimmed(const std::string& line) {
  return trim(std::string_view(line).substr(0, line.find('\r')));
}

/// `[balls]`, whatever follows it.
bool opens_section(const std::string& line, std::string_view name) {
  const auto text = trimmed(line);
  return text.starts_with("[") && text.find(']') != text.npos &&
         trim(text.substr(1, text.find(']') - 1)) == name;
}

/// Whether a line gives `name` a value: `name = …`.
bool sets(const std::string& line, std::string_view name) {
  const auto text = trimmed(line);
  const auto equals = text.find('=');
  return equals != text.npos && trim(text.substr(0, equals)) == name;
}

/// What follows the value of a line: blanks and a comment, or nothing.
std::string comment_of(const std::string& line) {
  const auto equals = line.find('=');
  const auto open = line.find_first_of("\"'", equals);
  const auto close = open == line.npos ? open : line.find(line[open], open + 1);
  const auto hash = line.find('#', close == line.npos ? equals : close);
  if (hash == line.npos)
    return {};
  return close == line.npos ? "  " + line.substr(hash) : line.substr(close + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/// The text with `name = "url"` in its section of balls.
std::string with_ball(const std::string& text, const std::string& name, const std::string& url) {
  auto lines = lines_of(text);
  const auto opened = std::ranges::find_if(
      lines, [](const auto& line) { return opens_section(line, balls_section); });
  const auto setting = fmt::format("{} = \"{}\"", name, url);
  if (opened == lines.end()) {
    if (!lines.empty() && !lines.back().empty())
      lines.emplace_back();
    lines.push_back(fmt::format("[{}]", balls_section));
    lines.push_back(setting);
  } else {
    const auto end = std::find_if(opened + 1, lines.end(),
                                  [](const auto& line) { return trimmed(line).starts_with("["); });
    const auto old =
        std::find_if(opened + 1, end, [&](const auto& line) { return sets(line, name); });
    if (old != end) {
      *old = setting + comment_of(*old);
    } else {
      auto after = end; // the last line of the section that says something
      while (trimmed(*(after - 1)).empty())
        --after;
      lines.insert(after, setting);
    }
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

bool same_but_for_place(const Setting& one, const Setting& other) {
  return one.section.name == other.section.name && one.option == other.option &&
         one.values == other.values;
}

/// Whether both name the same robots, wherever in the file.
bool same_balls(const Config& one, const Config& other) {
  return std::ranges::equal(one.balls, other.balls, [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.url == b.second.url && a.second.robot == b.second.robot;
  });
}

tl::unexpected<Failure> unsaved(ExitCode code, std::string message) {
  return tl::unexpected(Failure{code, std::move(message)});
}

} // namespace

bool is_ball_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_';
  });
}

tl::expected<std::string, Failure> settings_folder() {
  const auto path = user_file();
  if (!path)
    return unsaved(ExitCode::File, "there is no place for a configuration: neither "
                                   "XDG_CONFIG_HOME nor HOME is set");
  return path->parent_path().string();
}

tl::expected<std::string, Failure> save_ball(const std::string& name, const std::string& url) {
  if (!is_ball_name(name))
    return unsaved(ExitCode::Usage,
                   fmt::format("`{}` is not a name for a ball: letters, digits, - and _", name));
  if (url.find_first_of("\"\\\n\r") != url.npos)
    return unsaved(ExitCode::Usage, fmt::format("`{}` cannot stand in a configuration file", url));
  const auto folder = settings_folder();
  if (!folder)
    return tl::unexpected(folder.error());
  const auto path = user_file();
  const auto file = path->string();
  std::error_code error;
  if (fs::create_directories(*folder, error); error)
    return unsaved(ExitCode::File,
                   fmt::format("cannot make the folder of {}: {}", file, error.message()));
  // From reading it to writing it again nobody else may.
  constexpr Duration patience = 5s;
  const auto lock = disk::Lock::take(file, patience, "wait until that has ended, and save again");
  if (!lock)
    return unsaved(ExitCode::File, lock.error().message);
  std::string text;
  if (fs::exists(*path, error)) {
    auto read = disk::read(file);
    if (!read)
      return unsaved(ExitCode::File, read.error().message);
    text = *std::move(read);
  }
  const auto edited = with_ball(text, name, url);
  Config before;
  if (auto read = read_text_into(before, file, text); !read)
    return unsaved(ExitCode::Usage, read.error().message);
  before.balls[name].url = url;
  Config after; // what will be read of it
  if (!read_text_into(after, file, edited) || !same_balls(after, before) ||
      !std::ranges::equal(after.settings, before.settings, same_but_for_place))
    return unsaved(
        ExitCode::Usage,
        fmt::format("{0}: the balls in it are written in a way that is not edited; write "
                    "`{1} = \"{2}\"` there",
                    file, name, url));
  if (const auto written = disk::write(file, as_bytes(edited)); !written)
    return unsaved(ExitCode::File, written.error().message);
  return file;
}

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
        "a file of robots has the sections `[balls]` and `[groups]`; settings stand in orb.toml"));
  if (config.balls.empty())
    return tl::unexpected(problem(file, "there are no robots in it; write `[balls]` and under it a "
                                        "line such as `red = \"ble://SK-1A2B\"`"));
  return config;
}

tl::expected<void, ConfigError> apply_config(const Config& config, const Command& orb) {
  for (const auto& setting : config.settings)
    if (auto done = apply(setting, orb); !done)
      return done;
  return {};
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
  std::vector<std::string> names;
  for (const auto& [known, ball] : config.balls)
    names.push_back(known);
  return tl::unexpected(ConfigError{fmt::format(
      "unknown ball `{}`{}", name,
      names.empty() ? fmt::format("; `orb ports --save {}=URL` gives one that name", name)
                    : meant_instead(name, names))});
}

} // namespace orb::cli
