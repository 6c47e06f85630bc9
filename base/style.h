#pragma once

#include <string>
#include <string_view>

namespace orb {

/// The kind of terminal output; it determines the colour.
enum class Role { Error, Warning, Note, Good, Bold, Dim };

/// The colour setting. The edge decides it once (flag, NO_COLOR, terminal) and passes it down.
struct Style {
  bool color = false;

  /// Wraps `text` in the escape codes of `role`; returns it unchanged if colour is off.
  std::string paint(Role role, std::string_view text) const;
};

} // namespace orb
