#pragma once

// The values after a word of a line, as data. Tables of words have a column of slots; one reader
// (base/cursor.h) reads all of them and one printer describes them.

#include "base/texts.h"
#include "base/units.h"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// A value of a line.
struct Slot {
  enum class Kind : std::uint8_t {
    Number,
    Whole,
    Length,   ///< with a unit
    Range,    ///< `A..B`, with a unit if the slot has several
    Time,     ///< with a unit
    TimeSpan, ///< `TIME..TIME`
    Place,    ///< `X,Y`
    Axis,     ///< `x>70`
    Text,     ///< in quotes
    Match,    ///< a whole text, a part of one, or a pattern
    File,
    Choice, ///< one of a few words
    Zone,   ///< read by its language, quoted or not; so are the next three
    Macro,
    Variable, ///< also ends at a `=`
    Word,
    Version,
    Firmware,
    Seeds,
    Colour, ///< a word, or `#RRGGBB`
    Rest,   ///< read by its language
  };
  Kind kind = Kind::Rest;
  std::string_view shown;        ///< its name in the usage line: `TIME`
  const Row<>* called = nullptr; ///< its name in messages; null only for a Place, an Axis and a
                                 ///< Rest
  std::int64_t least = 0;        ///< of numbers
  std::int64_t most = 0;
  std::span<const Unit> units{}; ///< values count in the first one
  std::string_view usual{};      ///< the usual value; may be empty
  std::string_view words{};      ///< separated by `|`: of a choice; in place of a time; the signs
                                 ///< of an axis
  std::string_view before{};     ///< the word or sign in front of it
  bool may_lack = false;         ///< optional; needs a word in front, except for a Rest
  bool repeats = false;

  Message name() const { return (*called)(); }
  /// The words of a choice.
  std::vector<std::string_view> choices() const;
  /// True if its numbers have limits.
  constexpr bool is_limited() const { return least != most; }
  /// True if it takes any 32-bit number.
  constexpr bool is_any() const { return least == INT32_MIN && most == INT32_MAX; }

  constexpr Slot after(std::string_view word) const {
    auto slot = *this;
    slot.before = word;
    return slot;
  }
  constexpr Slot like(std::string_view text) const {
    auto slot = *this;
    slot.usual = text;
    return slot;
  }
  constexpr Slot or_none() const {
    auto slot = *this;
    slot.may_lack = true;
    return slot;
  }
};

/// The slots after a word.
struct Slots {
  static constexpr std::size_t most = 4;

  template <std::same_as<Slot>... All>
  constexpr Slots(All... each) : all{each...}, count(sizeof...(All)) {}

  constexpr const Slot* data() const { return all.data(); }
  constexpr const Slot* begin() const { return all.data(); }
  constexpr const Slot* end() const { return all.data() + count; }
  constexpr const Slot& operator[](std::size_t i) const { return all[i]; }
  constexpr std::size_t size() const { return count; }
  constexpr bool empty() const { return count == 0; }

  std::array<Slot, most> all;
  std::size_t count;
};

/// States the allowed values: `the heading must be 0 to 359`.
Message must_be(const Slot& slot);

/// Prints the syntax: `X,Y by LENGTH`, `FILE [at X,Y]`.
std::string usage(const Slots& slots);

/// Prints a word and its slots.
std::string usage(std::string_view word, const Slots& slots);

/// Slots that several tables use.
namespace slot {

using Kind = Slot::Kind;

constexpr Slot whole(std::string_view shown, const Row<>& called, std::int64_t least,
                     std::int64_t most) {
  return {Kind::Whole, shown, &called, least, most};
}
constexpr Slot number(std::string_view shown, const Row<>& called, std::int64_t least,
                      std::int64_t most) {
  return {Kind::Number, shown, &called, least, most};
}
/// One of several words, such as `on|off`.
constexpr Slot choice(std::string_view words, const Row<>& called) {
  return {.kind = Kind::Choice, .shown = words, .called = &called, .words = words};
}
constexpr Slot word(Kind kind, std::string_view shown, const Row<>& called) {
  return {kind, shown, &called};
}
/// A slot that its language reads itself, among others.
constexpr Slot rest(std::string_view shown) {
  return {Kind::Rest, shown};
}

inline constexpr Slot time{Kind::Time, "TIME", &texts::Time};
inline constexpr Slot place{Kind::Place, "X,Y"};
inline constexpr Slot file{Kind::File, "FILE", &texts::FileName};

} // namespace slot
} // namespace orb
