#pragma once

#include <filesystem>
#include <optional>

namespace orb::cli {

/// The user's home; nothing if there is none.
std::optional<std::filesystem::path> user_home();

/// The user's settings file, which may not exist yet; nothing if there is no place for it.
std::optional<std::filesystem::path> user_file();

/// True if a file belongs to the user or an administrator. Others could put a file into a parent
/// folder, so theirs is ignored.
bool is_trusted(const std::filesystem::path& path);

} // namespace orb::cli
