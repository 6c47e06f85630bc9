#pragma once

#include "structured/lower/code.h"

#include <cstdint>
#include <vector>

namespace orb::structured {

/// The robot's letter of each variable: 0 for A to 24 for Y, `no_letter` for an unused variable.
inline constexpr std::uint8_t no_letter = 0xFF;

struct LetterAllocation {
  std::vector<std::uint8_t> of; ///< of each variable
  /// If there are too few letters: a line with more live variables than letters, and those
  /// variables. Empty otherwise.
  std::uint32_t crowded_line = none;
  std::vector<std::uint32_t> crowd;
  std::uint32_t available = 0;
};

/// Allocates letters by liveness: two variables share one if neither is live when the other is set.
/// Copies share a letter if possible, and so disappear. `wishes` holds the preferred letter of each
/// variable, or `no_letter`.
LetterAllocation choose_letters(const Code& code, const std::vector<std::uint8_t>& wishes);

} // namespace orb::structured
