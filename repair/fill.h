#pragma once

#include "repair/idioms.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::repair {

/// The contents of the holes of a pattern, by letter.
struct Holes {
  std::array<Tokens, 26> of;
  std::string choice; ///< the literal matched among several
  Tokens rest;        ///< the rest of the line from that literal

  Tokens& operator[](char letter) { return of[static_cast<std::size_t>(letter - 'a')]; }
  const Tokens& operator[](char letter) const { return of[static_cast<std::size_t>(letter - 'a')]; }
};

inline constexpr std::int64_t full_circle = 360; // degrees

/// True if the tokens contain a name that other lines also use.
bool holds_name(const Tokens& tokens, const Surroundings& around);

/// Fills a template with the holes; nothing if a value does not have the required form.
std::optional<std::string> fill(std::string_view form, const Holes& holes,
                                const Surroundings& around);

/// The opposite of a condition, with as many comparisons as a condition may have; in orbBasic at
/// most two.
std::optional<std::string> opposite(Tokens condition, Language language);

} // namespace orb::repair
