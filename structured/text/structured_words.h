#pragma once

// The words of structured orbBasic: those of the robot's tables and its own. Case does not count.

#include "base/text/text.h"
#include "spec/basic.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace orb::structured {

/// Words missing from the robot's tables: the rows of structured/text/structured_words.def.
enum class Keyword : std::uint8_t {
#define ORB_KEYWORD(name, ...) name,
#include "structured/text/structured_words.def"
};

/// A word as shown in the reference.
struct WordInfo {
  std::string_view word;
  std::string_view usage;
  std::string_view summary;
  std::string_view example; ///< a whole program; may be empty
};

/// The keywords in the order of Keyword.
inline constexpr auto keywords = std::to_array<WordInfo>({
#define ORB_KEYWORD(name, word, usage, summary, example) {word, usage, summary, example},
#include "structured/text/structured_words.def"
});

/// The words alone.
inline constexpr auto keyword_words = [] {
  std::array<std::string_view, keywords.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = keywords[i].word;
  return words;
}();

/// Words of the robot with a wider meaning in structured programs.
inline constexpr auto wider_words = std::to_array<WordInfo>({
#define ORB_WIDER_WORD(word, usage, summary, example) {word, usage, summary, example},
#include "structured/text/structured_words.def"
});

enum class WordKind : std::uint8_t {
  Name,      ///< not a word of the language
  Keyword,   ///< `index` is a Keyword
  Statement, ///< `index` is a spec::Statement
  Function,  ///< `index` is a spec::Function
  Variable,  ///< `index` is a spec::Variable
};

struct Word {
  WordKind kind = WordKind::Name;
  std::uint8_t index = 0;

  constexpr bool is(Keyword keyword) const {
    return kind == WordKind::Keyword && index == static_cast<std::uint8_t>(keyword);
  }
  constexpr bool is(spec::Statement statement) const {
    return kind == WordKind::Statement && index == static_cast<std::uint8_t>(statement);
  }
};

constexpr bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}
constexpr bool begins_name(char c) {
  return is_letter(c) || c == '_';
}
constexpr bool is_name_char(char c) {
  return begins_name(c) || is_digit(c);
}

/// The end of a name or word that begins before `at`.
constexpr const char* end_of_name(const char* at, const char* end) {
  while (at != end && is_name_char(*at))
    ++at;
  return at;
}

/// The maximum length of a name, in characters.
inline constexpr std::size_t longest_name = 31;

/// The meaning of a word. `let` is not part of the language (the robot's own is undocumented).
Word find_word(std::string_view text);

/// True if a word takes its values in parentheses: the robot's functions, `min` and `max`.
constexpr bool is_function(Word word) {
  return word.kind == WordKind::Function || word.is(Keyword::Min) || word.is(Keyword::Max);
}

/// The documented spelling of a word; empty for a name.
std::string_view spelling(Word word);

/// The colour of this name, as 0xRRGGBB.
std::optional<std::uint32_t> find_colour(std::string_view name);

/// The names of all colours.
std::vector<std::string_view> colour_names();

} // namespace orb::structured
