#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// A line of any of the languages, split the way a person reads it: whatever was written, and
// without knowing which words there are.

namespace orb::repair {

enum class Language : std::uint8_t { Basic, Structured, Macro, Test };

struct Token {
  enum class Kind : std::uint8_t {
    Word,   ///< letters, digits and `_`; letters of other alphabets belong to it
    Number, ///< digits, perhaps with a point; `0x1F`
    Text,   ///< without its quotes
    Colour, ///< `#FF8000`
    Sign,   ///< one operator or bracket: `<=` is one
  };
  Kind kind = Kind::Sign;
  std::string text;
  bool gap = false;     ///< a blank stands before it
  bool closed = true;   ///< of a Text: its closing quote is there
  bool plain = true;    ///< of a Text: quoted with `"`
  std::uint32_t at = 0; ///< where it begins in the line

  bool is(std::string_view sign) const { return kind != Kind::Text && text == sign; }
  bool is_word() const { return kind == Kind::Word; }
  bool is_text() const { return kind == Kind::Text; }
  bool is_number() const { return kind == Kind::Number; }
  bool is_relation() const; ///< as any language writes them
};

using Tokens = std::vector<Token>;

/// Lines with more of them are not looked at.
inline constexpr std::size_t most_tokens = 64;

/// A line in its parts.
struct SplitLine {
  std::string head; ///< blanks, the line number and the blanks after it
  Tokens tokens;
  std::string comment; ///< with its sign, as the language writes it; empty without one
};

/// Splits a line (without its end). Comments of other languages (`//`, `#`, `REM`, `--`, `/* */`)
/// are comments; so is text in any quotes a text.
SplitLine split(std::string_view line, Language language);

/// Tokens of a part of a line: no number in front, no comment behind.
Tokens tokens_of(std::string_view text, Language language);

/// The line again; tokens are parted by a blank where they say so or must be.
std::string join(const SplitLine& line);
std::string join(const Tokens& tokens);

/// Whether one of them is that word or sign.
bool has_token(const Tokens& tokens, std::string_view text);

/// The tokens from `begin` to before `end`, as far as there are some.
Tokens slice(const Tokens& tokens, std::size_t begin, std::size_t end = SIZE_MAX);

/// Where the bracket ends that the token at `open` opens; the number of tokens where it does not.
std::size_t close_of(const Tokens& tokens, std::size_t open);

/// A word with a blank before it.
Token word(std::string_view text);

/// Takes tokens out; what follows has the blank that stood before them.
void take_out(Tokens& tokens, std::size_t at, std::size_t count);

/// Puts tokens behind others.
void append(Tokens& to, const Tokens& tokens);

/// The words in a word, in small letters: `setRoll` and `set_roll` are `set` and `roll`.
std::vector<std::string> parts_of(std::string_view word);

} // namespace orb::repair
