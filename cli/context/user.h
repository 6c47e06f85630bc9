#pragma once

#include <filesystem>
#include <optional>

namespace orb::cli {

/// The user's home; nothing where there is none.
std::optional<std::filesystem::path> user_home();

/// The user's own settings, which need not be there; nothing where there is no place for them.
std::optional<std::filesystem::path> user_file();

/// Whether a file is the user's, or of whoever administers this computer: what somebody else has
/// put into a folder above is not obeyed.
bool is_trusted(const std::filesystem::path& path);

} // namespace orb::cli
