#pragma once

#include <string>
#include <string_view>

namespace orb {

/// What a piece of terminal output is; the colour follows from it.
enum class Role { Error, Warning, Note, Good, Bold, Dim };

/// Whether output is coloured. The edge decides once (flag, NO_COLOR, terminal); the rest obeys.
struct Style {
  bool color = false;

  /// `text` wrapped in the escape codes of `role`, or unchanged where colour is off.
  std::string paint(Role role, std::string_view text) const;
};

} // namespace orb
