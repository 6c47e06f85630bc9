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

/// Sets of languages, one bit each, for the rows of a table.
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

/// True if a word is in a list, ignoring case.
bool has_word(std::span<const std::string_view> words, std::string_view word);

/// True if a word negates what follows, in any of the languages.
bool negates(const Token& token);

/// A line to repair, with facts from the lines around it.
struct Line : SplitLine {
  const Dialect* dialect = nullptr;
  const Scenery* scenery = nullptr;
  std::string_view written;  ///< as in the source
  std::uint32_t begin = 0;   ///< its offset in the source
  std::size_t head_size = 0; ///< of the head as written
  Surroundings around;
  std::vector<std::string_view> names; ///< words of other lines; in orbBasic: none
  std::string number_above;
  std::string sub;         ///< the program's sub that the line calls, correctly or not
  std::string like;        ///< the sub whose name means the same as the first word
  std::string meant;       ///< the only possible sub for a call of an unknown one
  bool is_target = false;  ///< a jump target
  bool misplaced = false;  ///< outside the block that it leaves
  bool incomplete = false; ///< a rewrite added a sign or a word

  Language language() const { return dialect->language; }
  /// True for a line of a program, numbered or structured.
  bool is_program() const {
    return language() == Language::Basic || language() == Language::Structured;
  }
  /// True if the language has the word, ignoring case.
  bool knows(std::string_view word) const { return has_word(dialect->words, word); }
  bool has_name(std::string_view word) const { return has_word(names, word); }
  bool is_elsewhere(std::string_view word) const { return has_word(around.elsewhere, word); }
  /// True if neither the language nor another line has the word. A single letter is never foreign.
  bool is_foreign(std::string_view word) const;
  /// True if a line of text contains a foreign word.
  bool has_foreign(std::string_view text) const;
  /// True if a token is an unknown word that does not negate.
  bool is_unknown(const Token& token) const;
  /// True if a token is a variable of the program.
  bool is_variable(const Token& token) const;
  /// The number of occurrences of a sign in the line.
  std::ptrdiff_t count_of(std::string_view sign) const;
  /// The line with another statement but the same head and comment.
  std::string with(std::string_view statement) const;
};

/// Makes the Line of a source line as written; normalise() prepares it for repair.
Line look_at(const Source& source, const Dialect& dialect, const Scenery& scenery,
             std::uint32_t number);

} // namespace orb::repair
