#pragma once

#include "repair/idioms.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::repair {

/// What the holes of a pattern hold, by their letter.
struct Holes {
  std::array<Tokens, 26> of;
  std::string choice; ///< the literal that was chosen among several
  Tokens rest;        ///< from that literal on

  Tokens& operator[](char letter) { return of[static_cast<std::size_t>(letter - 'a')]; }
  const Tokens& operator[](char letter) const { return of[static_cast<std::size_t>(letter - 'a')]; }
};

inline constexpr std::int64_t full_circle = 360; // degrees

/// Whether a name that other lines use, too, is among the tokens.
bool holds_name(const Tokens& tokens, const Surroundings& around);

/// The line that a template makes of the holes; nothing where a value has no such form.
std::optional<std::string> fill(std::string_view form, const Holes& holes,
                                const Surroundings& around);

/// The opposite of a condition, with as many comparisons as one condition has; in orbBasic at most
/// two.
std::optional<std::string> opposite(Tokens condition, Language language);

} // namespace orb::repair
