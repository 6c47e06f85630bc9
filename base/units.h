#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

// Numbers with units. Each language chooses the units it takes.

namespace orb {

enum class Measure : std::uint8_t { Number, Percent, Time, Length, Speed, Angle };

/// A unit and its size in steps of its measure: ns, µm, µm/s, millionths of a degree; for a plain
/// number, ones.
struct Unit {
  std::string_view word;
  Measure measure;
  std::int64_t steps;

  /// The ratio of this unit to `other`: a metre is 100 centimetres.
  constexpr double in(const Unit& other) const {
    return static_cast<double>(steps) / static_cast<double>(other.steps);
  }
};

namespace unit {
inline constexpr Unit one{"", Measure::Number, 1};
inline constexpr Unit ms{"ms", Measure::Time, 1'000'000};
inline constexpr Unit s{"s", Measure::Time, 1'000 * ms.steps};
inline constexpr Unit min{"min", Measure::Time, 60 * s.steps};
inline constexpr Unit h{"h", Measure::Time, 60 * min.steps};
inline constexpr Unit mm{"mm", Measure::Length, 1'000};
inline constexpr Unit cm{"cm", Measure::Length, 10 * mm.steps};
inline constexpr Unit dm{"dm", Measure::Length, 10 * cm.steps};
inline constexpr Unit m{"m", Measure::Length, 100 * cm.steps};
inline constexpr Unit in{"in", Measure::Length, 25'400};
inline constexpr Unit ft{"ft", Measure::Length, 12 * in.steps};
inline constexpr Unit yd{"yd", Measure::Length, 3 * ft.steps};
inline constexpr Unit cm_s{"cm/s", Measure::Speed, cm.steps};
inline constexpr Unit m_s{"m/s", Measure::Speed, m.steps};
inline constexpr Unit deg{"deg", Measure::Angle, 1'000'000};
} // namespace unit

/// Finds the unit by its word; null if there is none.
constexpr const Unit* find_unit(std::string_view word, std::span<const Unit> units) {
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const Unit& one) { return one.word == word; });
  return found == units.end() ? nullptr : &*found;
}

/// A number at the front, `-2.5`, and the rest, `cm`. A point belongs to the number if a digit
/// follows it.
struct Amount {
  std::string_view number;
  std::string_view rest;
};
Amount split_amount(std::string_view text);

struct Steps {
  std::int64_t count = 0;
  bool exact = true; ///< false: truncated towards zero
};

/// Parses all of `number`, such as `-2.5`, into steps, `per` to one. Returns nothing if it is
/// malformed or too large.
std::optional<Steps> steps_of(std::string_view number, std::int64_t per);

/// Parses `0x1F`; saturates. Returns nothing if it is malformed.
std::optional<std::int64_t> hexadecimal(std::string_view text);

/// Prints thousandths as a number: `-2.5`.
std::string thousandths_text(std::int64_t thousandths);

} // namespace orb
