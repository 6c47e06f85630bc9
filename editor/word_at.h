#pragma once

// Words of a line in any of the languages; the text need not parse.

#include "base/source.h"
#include "base/text/text.h"
#include "spec/basic.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace orb::editor {

enum class TokenKind : std::uint8_t { Number, Word, String, Comment, Sign };

struct Token {
  TokenKind kind = TokenKind::Sign;
  Span span;
};

/// How a language splits lines into words.
struct Lexis {
  char comment = '\'';
  /// Digits and `_` are part of words; units and fractions are part of numbers.
  bool has_names = true;
  /// `\"` is a quote within a text.
  bool has_escapes = false;
  /// `#` with six hex digits is a number, not a comment.
  bool has_colours = false;
};

inline constexpr Lexis basic_lexis{'\'', false, false, false};
inline constexpr Lexis structured_lexis{'\'', true, false, true};
inline constexpr Lexis macro_lexis{'#', true, true, false};
inline constexpr Lexis test_lexis{'#', true, false, true};

/// The tokens of line `line` (from 1). A text without its closing quote ends at the end of the
/// line.
std::vector<Token> tokens_of_line(const Source& source, std::uint32_t line, Lexis lexis);

/// The tokens of the line that contains `offset`.
std::vector<Token> tokens_at(const Source& source, std::uint32_t offset, Lexis lexis);

/// The tokens of the whole text.
std::vector<Token> tokens_of(const Source& source, Lexis lexis);

/// True if a text lacks its closing quote.
bool is_open(const Source& source, const Token& text);

/// True if a statement decides what runs next: `goto`, `for`, `return`.
bool directs_the_flow(const spec::StatementInfo& row);

constexpr bool touches(Span span, std::uint32_t offset) {
  return span.begin <= offset && offset <= span.end;
}

/// True for characters of rule ids.
constexpr bool is_rule_part(char c) {
  return is_letter(c) || is_digit(c) || c == '-';
}

/// Extends the span of a subexpression to its closing parentheses: the parsers' spans end at the
/// last operand.
Span with_closing(const Source& source, Span span);

/// The byte where the line with `offset` ends, without its line break.
std::uint32_t end_of_line(const Source& source, std::uint32_t offset);

} // namespace orb::editor
