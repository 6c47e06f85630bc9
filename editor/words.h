#pragma once

// The words of a line of any of the languages, for text that need not parse.

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

/// How a language cuts its lines into words.
struct Lexis {
  char comment = '\'';
  /// Whether digits and `_` belong to words, and a unit and a fraction to numbers.
  bool has_names = true;
  /// Whether `\"` stands for a quote in a text.
  bool has_escapes = false;
  /// Whether `#` and six hex digits are a number, not a comment.
  bool has_colours = false;
};

inline constexpr Lexis basic_lexis{'\'', false, false, false};
inline constexpr Lexis structured_lexis{'\'', true, false, true};
inline constexpr Lexis macro_lexis{'#', true, true, false};
inline constexpr Lexis test_lexis{'#', true, false, true};

/// The tokens of line `line` (from 1). A text without its closing quote ends with the line.
std::vector<Token> tokens_of_line(const Source& source, std::uint32_t line, Lexis lexis);

/// The tokens of the line that holds `offset`.
std::vector<Token> tokens_at(const Source& source, std::uint32_t offset, Lexis lexis);

/// The tokens of the whole text.
std::vector<Token> tokens_of(const Source& source, Lexis lexis);

/// Whether a text lacks its closing quote.
bool is_open(const Source& source, const Token& text);

/// Whether a statement decides what runs next: `goto`, `for`, `return`.
bool directs_the_flow(const spec::StatementInfo& row);

constexpr bool touches(Span span, std::uint32_t offset) {
  return span.begin <= offset && offset <= span.end;
}

/// Whether a rule's id may hold `c`.
constexpr bool is_rule_part(char c) {
  return is_letter(c) || is_digit(c) || c == '-';
}

/// A part of an expression with the parentheses behind it that close those in it: the spans of the
/// parsers end at the last operand.
Span with_closing(const Source& source, Span span);

/// The byte where the line that holds `offset` ends, its line end not counted.
std::uint32_t end_of_line(const Source& source, std::uint32_t offset);

} // namespace orb::editor
