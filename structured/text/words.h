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

/// Words that the robot's tables do not have: the rows of structured/text/words.def.
enum class Keyword : std::uint8_t {
#define ORB_KEYWORD(name, ...) name,
#include "structured/text/words.def"
};

/// A word as people look it up.
struct WordInfo {
  std::string_view word;
  std::string_view usage;
  std::string_view summary;
  std::string_view example; ///< a whole program; may be empty
};

/// The keywords in the order of Keyword.
inline constexpr auto keywords = std::to_array<WordInfo>({
#define ORB_KEYWORD(name, word, usage, summary, example) {word, usage, summary, example},
#include "structured/text/words.def"
});

/// The same, only the words.
inline constexpr auto keyword_words = [] {
  std::array<std::string_view, keywords.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = keywords[i].word;
  return words;
}();

/// Words of the robot that mean more in structured programs.
inline constexpr auto wider_words = std::to_array<WordInfo>({
#define ORB_WIDER_WORD(word, usage, summary, example) {word, usage, summary, example},
#include "structured/text/words.def"
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

/// Where a name or a word ends that has begun before `at`.
constexpr const char* end_of_name(const char* at, const char* end) {
  while (at != end && is_name_char(*at))
    ++at;
  return at;
}

/// The characters that a name may have.
inline constexpr std::size_t longest_name = 31;

/// What a word means; `let` is none of the language's (the robot's own is undocumented).
Word find_word(std::string_view text);

/// Whether a word takes its values in parentheses: the robot's functions, `min` and `max`.
constexpr bool is_function(Word word) {
  return word.kind == WordKind::Function || word.is(Keyword::Min) || word.is(Keyword::Max);
}

/// A word in its documented spelling; empty for a name.
std::string_view spelling(Word word);

/// 0xRRGGBB of the colour of that name.
std::optional<std::uint32_t> find_colour(std::string_view name);

/// The names of all colours.
std::vector<std::string_view> colour_names();

} // namespace orb::structured
