#pragma once

// The tables of colours. The rows and their columns are in spec/colours.def.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace orb::spec {

/// A named colour.
struct Colour {
  std::string_view name; ///< after `RGB` in a structured program; empty: none
  std::uint32_t rgb;
  std::string_view words; ///< all words for it, the name included, space-separated
};

inline constexpr auto colours = std::to_array<Colour>({
#define ORB_COLOUR(name, rgb, words) {name, rgb, words},
#include "spec/colours.def"
});

/// The predefined colours of LEDC; the index into the table is the argument.
struct LedColour {
  std::uint8_t code;
  std::string_view name;
  std::uint8_t red;
  std::uint8_t green;
  std::uint8_t blue;
};

inline constexpr auto led_colours = std::to_array<LedColour>({
#define ORB_LED_COLOUR(code, name, rgb) {code, name, (rgb) >> 16, (rgb) >> 8 & 0xFF, (rgb)&0xFF},
#include "spec/colours.def"
});

consteval bool led_codes_ascend() {
  for (std::size_t i = 0; i < led_colours.size(); ++i)
    if (led_colours[i].code != i)
      return false;
  return true;
}
static_assert(led_codes_ascend());

} // namespace orb::spec
