#pragma once

// Private to repair/.

#include "repair/repair.h"
#include "repair/scenery.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// Sets of languages, a bit for each: of which a row of a table is.
namespace in {
constexpr std::uint8_t bit(Language language) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(language));
}
inline constexpr std::uint8_t basic = bit(Language::Basic);
inline constexpr std::uint8_t structured = bit(Language::Structured);
inline constexpr std::uint8_t macro = bit(Language::Macro);
inline constexpr std::uint8_t test = bit(Language::Test);
inline constexpr std::uint8_t programs = basic | structured;
inline constexpr std::uint8_t all = programs | macro | test;
} // namespace in

/// Whether a word is one of them, in capitals or not.
bool has_word(std::span<const std::string_view> words, std::string_view word);

/// Whether a word turns what follows into its opposite, in any of the languages.
bool negates(const Token& token);

/// A line that is to be mended, and what the lines around it tell.
struct Line : SplitLine {
  const Dialect* dialect = nullptr;
  const Scenery* scenery = nullptr;
  std::string_view written;  ///< as it stands in the text
  std::uint32_t begin = 0;   ///< where that is in the text
  std::size_t head_size = 0; ///< of the head as it is written
  Surroundings around;
  std::vector<std::string_view> names;   ///< words of other lines; of orbBasic: none
  std::vector<std::string_view> letters; ///< of orbBasic: variables that other lines use
  std::string number_below;
  std::string sub;         ///< of the program, which the line calls, rightly or not
  std::string like;        ///< the sub whose name means what the first word says
  std::string meant;       ///< the sub that a call of an unknown one can only mean
  bool is_target = false;  ///< something jumps here
  bool misplaced = false;  ///< it has nothing to leave
  bool incomplete = false; ///< a rewrite put in a sign or a word that nobody typed

  Language language() const { return dialect->language; }
  /// Whether it is a line of a program, numbered or structured.
  bool is_program() const {
    return language() == Language::Basic || language() == Language::Structured;
  }
  /// Whether the language has the word, in capitals or not.
  bool knows(std::string_view word) const { return has_word(dialect->words, word); }
  bool has_name(std::string_view word) const { return has_word(names, word); }
  bool is_elsewhere(std::string_view word) const { return has_word(around.elsewhere, word); }
  /// Whether neither the language nor another line has the word; one letter is never foreign.
  bool is_foreign(std::string_view word) const;
  /// Whether one of the words of a line of text is foreign.
  bool has_foreign(std::string_view text) const;
  /// Whether a token is a word that nobody knows and that does not negate.
  bool is_unknown(const Token& token) const;
  /// Whether a token is a variable of the program.
  bool is_variable(const Token& token) const;
  /// How often a sign stands in the line.
  std::ptrdiff_t count_of(std::string_view sign) const;
  /// The line with another statement: the same head and comment.
  std::string with(std::string_view statement) const;
};

/// A line of a text as it is written; normalise() makes of it what is mended.
Line look_at(const Source& source, const Dialect& dialect, const Scenery& scenery,
             std::uint32_t number);

} // namespace orb::repair
