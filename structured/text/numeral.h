#pragma once

#include <cstdint>
#include <string_view>

namespace orb::structured {

/// A number as written, with its unit.
struct Numeral {
  enum class Validity : std::uint8_t { Good, Bad, Fraction };
  Validity validity = Validity::Good;
  bool duration = false;
  std::int32_t value = 0;
};

/// Reads `12`, `0x1F`, `250ms`, `1.5s` or `2min`: a digit, then letters, digits and points.
Numeral read_numeral(std::string_view text);

} // namespace orb::structured
