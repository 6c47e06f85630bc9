#pragma once

#include "cli/context/config.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

// The syntax of configuration files, for code that reads or writes them. Private to this folder.

namespace orb::cli {

inline constexpr std::string_view balls_section = "balls";
inline constexpr std::string_view groups_section = "groups";

/// A message with its place.
ConfigError problem(const std::string& where, std::string_view what);

/// Adds the settings in a text to `config`; `file` is its name for messages.
tl::expected<void, ConfigError> read_text_into(Config& config, const std::string& file,
                                               const std::string& text);
/// The same for a file.
tl::expected<void, ConfigError> read_into(Config& config, const std::filesystem::path& path);

} // namespace orb::cli
