#pragma once

// Private to testing/.

#include "base/units.h"
#include "repair/tokens.h"

#include <string>
#include <string_view>
#include <vector>

// A line as a person reads it: words with all their possible meanings, numbers with units, texts,
// files. Later steps decide how they belong together.

namespace orb::testing {

struct Amount {
  std::string number; ///< with its sign; empty if there is none
  const Unit* unit = nullptr;

  double value() const; ///< converted to `unit`
  bool is(Measure measure) const { return unit != nullptr && unit->measure == measure; }
  bool is_bare() const { return unit == nullptr; }
};

struct Piece {
  enum class Kind : std::uint8_t {
    Word,
    Number, ///< with its unit, in `most`
    Span,   ///< from `least` to `most`, the smaller one first
    Text,   ///< a text, a part of one, or a pattern
    File,
    Sign, ///< a separator, or an unreadable character
  };
  using enum Kind;
  Kind kind = Sign;
  std::string text;                            ///< as test files write it
  std::vector<std::string_view> meanings = {}; ///< for a Word; the empty string means filler
  std::string colour = {};                     ///< for a Word, or a Text that is one
  std::string inner = {};                      ///< for a Text: without its quotes
  Amount least = {};
  Amount most = {};
  char axis = '\0';      ///< `x` or `y` before an amount
  std::string sign = {}; ///< `<`, `<=`, `>`, `>=` or `=` before an amount
  bool is_count = false; ///< followed or preceded by `times`

  bool is(Kind what) const { return kind == what; }
  bool means(std::string_view meaning) const;
  /// true if it means one of these, separated by blanks
  bool means_any(std::string_view all) const;
  /// True if it may be left out.
  bool says_nothing() const { return kind == Kind::Word && means(""); }
  bool is_time() const { return kind == Number && most.is(Measure::Time); }
};

using Pieces = std::vector<Piece>;

Pieces pieces_of(const repair::Tokens& line);

/// Returns all that a word may mean in a test file, including the word itself if it is one of its
/// words.
std::vector<std::string_view> meanings_of(std::string_view word);

/// True for a word of test files, in upper or lower case.
bool is_of_tests(std::string_view word);

/// True if a text is the name of a file that tests can use.
bool is_file(std::string_view name);

/// Returns the end of the file name that begins at `at`; `at` if there is none.
std::size_t file_end(const repair::Tokens& line, std::size_t at);

} // namespace orb::testing
