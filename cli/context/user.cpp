#include "cli/context/user.h"

#include <cstdlib>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace orb::cli {

namespace fs = std::filesystem;

std::optional<fs::path> user_home() {
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home);
  return std::nullopt;
}

std::optional<fs::path> user_file() {
  if (const char* xdg = std::getenv("XDG_CONFIG_HOME"); xdg != nullptr && *xdg != '\0')
    return fs::path(xdg) / "orb" / "config.toml";
  if (const auto home = user_home())
    return *home / ".config" / "orb" / "config.toml";
  return std::nullopt;
}

/// Accepts files of the user behind sudo, too.
bool is_trusted(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return false;
  const char* sudo = std::getenv("SUDO_UID");
  const bool sudoed = ::geteuid() == 0 && sudo != nullptr && std::to_string(status.st_uid) == sudo;
  return status.st_uid == ::geteuid() || status.st_uid == 0 || sudoed;
}

} // namespace orb::cli
