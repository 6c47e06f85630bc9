#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Splits a line of any language as a person would read it. Accepts any input and knows no
// vocabulary.

namespace orb::repair {

enum class Language : std::uint8_t { Basic, Structured, Macro, Test };

struct Token {
  enum class Kind : std::uint8_t {
    Word,   ///< letters, digits and `_`, including letters of other alphabets
    Number, ///< digits, optionally with a point; `0x1F`
    Text,   ///< without its quotes
    Colour, ///< `#FF8000`
    Sign,   ///< one operator or bracket: `<=` is one
  };
  Kind kind = Kind::Sign;
  std::string text;
  bool gap = false;     ///< preceded by a space
  bool closed = true;   ///< for a Text: it has its closing quote
  bool plain = true;    ///< for a Text: quoted with `"`
  std::uint32_t at = 0; ///< its offset in the line

  bool is(std::string_view sign) const { return kind != Kind::Text && text == sign; }
  bool is_word() const { return kind == Kind::Word; }
  bool is_text() const { return kind == Kind::Text; }
  bool is_number() const { return kind == Kind::Number; }
  bool is_relation() const; ///< in any language
};

using Tokens = std::vector<Token>;

/// Lines with more tokens are skipped.
inline constexpr std::size_t most_tokens = 64;

/// A line in its parts.
struct SplitLine {
  std::string head; ///< leading spaces, the line number and the spaces after it
  Tokens tokens;
  std::string comment; ///< with its sign in the notation of the language; empty if there is none
};

/// Splits a line (without its line ending). Recognizes comments of other languages (`//`, `#`,
/// `REM`, `--`, `/* */`) and texts in any quotes.
SplitLine split(std::string_view line, Language language);

/// Splits a part of a line, without a number or a comment.
Tokens tokens_of(std::string_view text, Language language);

/// Joins a split line; puts a space where a token has a gap or needs one.
std::string join(const SplitLine& line);
std::string join(const Tokens& tokens);

/// True if one of the tokens is this word or sign.
bool has_token(const Tokens& tokens, std::string_view text);

/// The tokens from `begin` up to `end` (exclusive), clipped to the line.
Tokens slice(const Tokens& tokens, std::size_t begin, std::size_t end = SIZE_MAX);

/// The closing bracket for the token at `open`; the number of tokens if there is none.
std::size_t close_of(const Tokens& tokens, std::size_t open);

/// True if a word has only letters that look like digits: `OO`.
bool looks_like_digits(std::string_view word);

/// The digits that a text looks like: `5O` is `50`. Other signs stay.
std::string as_digits(std::string text);

/// A word preceded by a space.
Token word(std::string_view text);

/// Removes tokens; the next token inherits their leading space.
void take_out(Tokens& tokens, std::size_t at, std::size_t count);

/// Appends tokens.
void append(Tokens& to, const Tokens& tokens);

/// Splits an identifier into lower-case words: `setRoll` and `set_roll` give `set` and `roll`.
std::vector<std::string> parts_of(std::string_view word);

} // namespace orb::repair
