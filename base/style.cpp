#include "base/style.h"

#include <fmt/format.h>

namespace orb {
namespace {

std::string_view code(Role role) {
  switch (role) {
  case Role::Error: return "1;31";
  case Role::Warning: return "1;35";
  case Role::Note: return "1;36";
  case Role::Good: return "1;32";
  case Role::Bold: return "1";
  case Role::Dim: return "2";
  }
  return "0";
}

} // namespace

std::string Style::paint(Role role, std::string_view text) const {
  if (!color)
    return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", code(role), text);
}

} // namespace orb
