#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

/// A section of a configuration file: the name of a command, or empty for all commands.
struct Section {
  std::string name;
  std::string place; ///< `FILE:LINE:COLUMN`
};

/// One setting of a configuration file, with its place for messages.
struct Setting {
  std::string file;
  std::string place; ///< `FILE:LINE:COLUMN`
  Section section;
  std::string option; ///< the long option's name without dashes
  std::vector<std::string> values;
};

/// A robot with a name: `[balls] red = "URL"`, or `red = { port = "URL", robot = "bolt" }`.
struct KnownBall {
  std::string url;
  std::string robot;      ///< a row of spec/robots.def; empty if the port has to tell
  std::string place;      ///< `FILE:LINE:COLUMN`
  std::uint32_t line = 0; ///< line in its file
};

/// A group of robots: `[groups] front = ["red", "blue"]`.
struct Group {
  struct Member {
    std::string name;
    std::string place;
  };
  std::vector<Member> members;
  std::string place;
};

/// The contents of the configuration files. `orb.toml`, found upwards from the working folder,
/// overrides `$XDG_CONFIG_HOME/orb/config.toml`.
struct Config {
  std::map<std::string, KnownBall> balls; ///< used as `@red`
  std::map<std::string, Group> groups;    ///< used as `@front`
  std::vector<Setting> settings;          ///< later ones override earlier ones
};

/// Why a configuration cannot be used: the sentence to print.
struct ConfigError {
  std::string message;
};

/// Reads the configuration files; missing ones are fine.
tl::expected<Config, ConfigError> load_config();

/// Reads a file of robots: `[balls]` and `[groups]` only.
tl::expected<Config, ConfigError> read_roster(const std::string& file);

/// Makes the settings the defaults of their options; flags and environment still override them.
/// Unknown sections, options and values are errors.
tl::expected<void, ConfigError> apply_config(const Config& config, const Command& orb);

/// The library's message for a TOML error, without its preface.
std::string toml_words(std::string_view description);

/// The names in a map.
template <class Map>
std::vector<std::string> names_in(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map)
    names.push_back(name);
  return names;
}

/// The message for an unknown name; `names` are the candidates.
std::string unknown_ball(const std::string& name, const std::vector<std::string>& names);

/// Returns the URL for `@name`, else `port` itself.
tl::expected<std::string, ConfigError> resolve_port(const Config& config, const std::string& port);

} // namespace orb::cli
