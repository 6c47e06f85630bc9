#pragma once

#include "structured/lower/code.h"

#include <cstdint>
#include <vector>

namespace orb::structured {

/// Which letter of the robot holds each variable: 0 for A to 24 for Y, `no_letter` for a variable
/// that nothing uses.
inline constexpr std::uint8_t no_letter = 0xFF;

struct Letters {
  std::vector<std::uint8_t> of; ///< of each variable
  /// Where letters do not suffice: a line at which more variables are in use than there are
  /// letters, and those variables. Empty otherwise.
  std::uint32_t crowded_line = none;
  std::vector<std::uint32_t> crowd;
  std::uint32_t available = 0;
};

/// Gives letters by lifetimes: two variables share one where neither is needed while the other is
/// set. Copies share where they can, and so vanish. `wishes` holds the letter that each variable
/// would like, or `no_letter`.
Letters choose_letters(const Code& code, const std::vector<std::uint8_t>& wishes);

} // namespace orb::structured
