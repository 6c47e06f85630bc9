#include "editor/word_at.h"

#include "base/text/text.h"

#include <algorithm>

namespace orb::editor {
namespace {

bool is_hex(char c) {
  return is_digit(c) || (to_lower(c) >= 'a' && to_lower(c) <= 'f');
}

class LineCutter {
public:
  LineCutter(std::string_view line, Lexis lexis) : line_(line), lexis_(lexis) {}

  TokenKind kind_at(std::size_t at) const {
    const char c = line_[at];
    if (c == '#' && lexis_.has_colours && is_colour(at))
      return TokenKind::Number;
    if (c == lexis_.comment)
      return TokenKind::Comment;
    if (c == '"')
      return TokenKind::String;
    if (is_digit(c))
      return TokenKind::Number;
    return is_word_part(c) && !is_digit(c) ? TokenKind::Word : TokenKind::Sign;
  }

  /// One past the last byte of the token of this kind at `at`.
  std::size_t end_of(std::size_t at, TokenKind kind) const {
    switch (kind) {
    case TokenKind::Comment: return line_.size();
    case TokenKind::String: return end_of_text(at);
    case TokenKind::Sign: return at + 1;
    case TokenKind::Number: return end_of_number(at);
    case TokenKind::Word: break;
    }
    while (at < line_.size() && is_word_part(line_[at]))
      ++at;
    return at;
  }

private:
  bool is_word_part(char c) const {
    return is_letter(c) || c == '_' || (lexis_.has_names && is_digit(c));
  }

  bool is_colour(std::size_t at) const {
    constexpr std::size_t digits = 6;
    const auto rest = line_.substr(at + 1);
    return rest.size() >= digits && std::all_of(rest.begin(), rest.begin() + digits, is_hex) &&
           (rest.size() == digits || !is_word_part(rest[digits]));
  }

  std::size_t end_of_text(std::size_t at) const {
    ++at;
    while (at < line_.size() && line_[at] != '"')
      at += lexis_.has_escapes && line_[at] == '\\' ? 2 : 1;
    return std::min(at + 1, line_.size());
  }

  std::size_t end_of_number(std::size_t at) const {
    ++at;
    for (; at < line_.size(); ++at) {
      const bool is_point =
          lexis_.has_names && line_[at] == '.' && at + 1 < line_.size() && is_digit(line_[at + 1]);
      if (!is_point && !(lexis_.has_names ? is_word_part(line_[at]) : is_digit(line_[at])))
        break;
    }
    return at;
  }

  std::string_view line_;
  Lexis lexis_;
};

void add_tokens(const Source& source, std::uint32_t number, Lexis lexis,
                std::vector<Token>& tokens) {
  const auto line = source.line(number);
  const auto start = source.line_start(number);
  const LineCutter cutter(line, lexis);
  for (std::size_t at = 0; at < line.size();) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    const auto kind = cutter.kind_at(at);
    const auto end = cutter.end_of(at, kind);
    tokens.push_back(
        {kind, {start + static_cast<std::uint32_t>(at), start + static_cast<std::uint32_t>(end)}});
    at = end;
  }
}

} // namespace

std::vector<Token> tokens_of_line(const Source& source, std::uint32_t line, Lexis lexis) {
  std::vector<Token> tokens;
  add_tokens(source, line, lexis, tokens);
  return tokens;
}

std::vector<Token> tokens_at(const Source& source, std::uint32_t offset, Lexis lexis) {
  return tokens_of_line(source, source.position(offset).line, lexis);
}

std::vector<Token> tokens_of(const Source& source, Lexis lexis) {
  std::vector<Token> tokens;
  for (std::uint32_t line = 1; line <= source.line_count(); ++line)
    add_tokens(source, line, lexis, tokens);
  return tokens;
}

bool is_open(const Source& source, const Token& text) {
  const auto written = source.text(text.span);
  return written.size() < 2 || !written.ends_with('"');
}

bool directs_the_flow(const spec::StatementInfo& row) {
  return row.after == spec::After::Steers || row.after == spec::After::Jumps ||
         row.statement == spec::Statement::Return || row.statement == spec::Statement::End;
}

Span with_closing(const Source& source, Span span) {
  int open = 0;
  for (const char c : source.text(span))
    open += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
  const auto line_end = end_of_line(source, span.end);
  for (auto at = span.end; open > 0 && at < line_end; ++at) {
    const char c = source.text()[at];
    if (c == ')' || c == ']') {
      --open;
      span.end = at + 1;
    } else if (!is_blank(c)) {
      break;
    }
  }
  return span;
}

std::uint32_t end_of_line(const Source& source, std::uint32_t offset) {
  return source.line_span(source.position(offset).line).end;
}

} // namespace orb::editor
