#pragma once

#include "base/text/text.h"

#include <string_view>

namespace orb {

/// True if the path begins with a Windows drive: `C:/robots/square.bas`.
constexpr bool has_drive(std::string_view path) {
  return path.size() > 2 && is_letter(path[0]) && path[1] == ':' &&
         (path[2] == '/' || path[2] == '\\');
}

/// True if the path is absolute, on Unix or Windows.
constexpr bool is_absolute_path(std::string_view path) {
  return path.starts_with('/') || has_drive(path);
}

} // namespace orb
