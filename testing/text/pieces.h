#pragma once

// Private to testing/.

#include "base/units.h"
#include "repair/tokens.h"

#include <string>
#include <string_view>
#include <vector>

// A line as a person reads it: words with all that they may mean, numbers with their units, texts,
// files. Which of it belongs together is not asked here.

namespace orb::testing {

struct Amount {
  std::string number; ///< with its sign; empty: none
  const Unit* unit = nullptr;

  double value() const; ///< in its unit
  bool is(Measure measure) const { return unit != nullptr && unit->measure == measure; }
  bool is_bare() const { return unit == nullptr; }
};

struct Piece {
  enum class Kind : std::uint8_t {
    Word,
    Number, ///< with its unit, in `most`
    Span,   ///< from `least` to `most`, the smaller first
    Text,   ///< a text, a part of one, or a pattern
    File,
    Sign, ///< one that parts, or that nobody can read
  };
  using enum Kind;
  Kind kind = Sign;
  std::string text;                            ///< as test files write it
  std::vector<std::string_view> meanings = {}; ///< of a Word; what says nothing is the empty one
  std::string colour = {};                     ///< of a Word, and of a Text that is one
  std::string inner = {};                      ///< of a Text: without its quotes
  Amount least = {};
  Amount most = {};
  char axis = '\0';      ///< `x` or `y`, where one stands before an amount
  std::string sign = {}; ///< `<`, `<=`, `>`, `>=` or `=`, where one stands before an amount
  bool is_count = false; ///< `times` stands beside it

  bool is(Kind what) const { return kind == what; }
  bool means(std::string_view meaning) const;
  bool means_any(std::string_view all) const; ///< one of them, with blanks between
  /// Whether it may be left out.
  bool says_nothing() const { return kind == Kind::Word && means(""); }
  bool is_time() const { return kind == Number && most.is(Measure::Time); }
};

using Pieces = std::vector<Piece>;

Pieces pieces_of(const repair::Tokens& line);

/// All that a word may mean in a test file: itself where it is of its language.
std::vector<std::string_view> meanings_of(std::string_view word);

/// Whether a word is one of test files, in small letters or not.
bool is_of_tests(std::string_view word);

/// Whether a text names a file that tests can name.
bool is_file(std::string_view name);

/// Where the name of a file ends that begins at `at`; `at` where none does.
std::size_t file_end(const repair::Tokens& line, std::size_t at);

} // namespace orb::testing
