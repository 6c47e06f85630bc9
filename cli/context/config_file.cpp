#include "cli/context/config_file.h"

#include "base/text/text.h"
#include "cli/model/checks.h"
#include "disk/disk.h"
#include "spec/robots.h"

#include <fmt/format.h>
#include <sstream>
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

namespace orb::cli {

namespace fs = std::filesystem;

ConfigError problem(const std::string& where, std::string_view what) {
  return {fmt::format("{}: {}", where, what)};
}

namespace {

std::string place_in(const std::string& file, const toml::source_position& at) {
  return fmt::format("{}:{}:{}", file, at.line, at.column);
}

std::string place_in(const std::string& file, const toml::node& node) {
  return place_in(file, node.source().begin);
}

/// A value as words of a command line; nothing if it cannot be one.
std::optional<std::string> value_words(const toml::node& value) {
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
                fmt::format("`{}` takes strings, numbers, booleans, or a list of them", name)));
  };
  if (const auto* list = node.as_array()) {
    for (const auto& value : *list) {
      auto words = value_words(value);
      if (!words)
        return wrong(value);
      values.push_back(*std::move(words));
    }
    return values;
  }
  auto words = value_words(node);
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
                  fmt::format("ball `{}` takes `port` and `robot`, not `{}`{}", name, key.str(),
                              meant_instead(std::string(key.str()), keys))));
    if (text == nullptr)
      return refuse(file, node,
                    fmt::format("`{}` of ball `{}` must be text in quotes", key.str(), name));
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
                    fmt::format("the group `{}` must be a list of balls: {}", name.str(), example));
    if (list->empty())
      return refuse(file, node,
                    fmt::format("the group `{}` is empty; write {}", name.str(), example));
    Group group;
    group.place = place_in(file, name.source().begin);
    for (const auto& member : *list) {
      const auto* text = member.as_string();
      if (text == nullptr)
        return refuse(
            file, member,
            fmt::format("the group `{}` must be a list of names: {}", name.str(), example));
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
    return tl::unexpected(
        problem(place_in(file, node),
                fmt::format("`[{}.{}]` is nested too deeply; sections are `[balls]` or "
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

/// The hint for a value that is invalid TOML, usually for lack of quotes: `for = 60s`.
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
  return fmt::format("; text goes in quotes: `{} = \"{}\"`", trim(line.substr(0, equals)), value);
}

} // namespace

tl::expected<void, ConfigError> read_text_into(Config& config, const std::string& file,
                                               const std::string& text) {
  const auto parsed = toml::parse(text, file);
  if (!parsed) {
    const auto& error = parsed.error();
    constexpr std::string_view twice = "cannot redefine existing string '";
    if (const auto at = error.description().find(twice); at != std::string_view::npos) {
      auto name = error.description().substr(at + twice.size());
      name = name.substr(0, name.find('\''));
      return tl::unexpected(
          problem(place_in(file, error.source().begin),
                  fmt::format("`{}` is given twice; give one of them another name, "
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
  return read_text_into(config, path.generic_string(), *text);
}

} // namespace orb::cli
