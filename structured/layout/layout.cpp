#include "structured/layout/layout.h"

#include "base/text/utf8.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace orb::structured {
namespace {

enum class TokenKind : std::uint8_t { Word, Name, Number, Text, Sign, Comment };

struct Token {
  TokenKind kind;
  std::string_view text;
};

/// Splits one line of the text into tokens.
std::vector<Token> tokens_of(std::string_view line) {
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < line.size();) {
    const char c = line[i];
    if (is_blank(c)) {
      ++i;
      continue;
    }
    auto end = i + 1;
    auto kind = TokenKind::Sign;
    const bool colour =
        c == '#' && line.size() >= i + 7 &&
        std::all_of(line.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                    line.begin() + static_cast<std::ptrdiff_t>(i) + 7, is_name_char);
    if (c == '\'' || (c == '#' && !colour) || line.substr(i).starts_with("//")) {
      kind = TokenKind::Comment;
      end = line.size();
      while (end > i && is_blank(line[end - 1]))
        --end;
      tokens.push_back({kind, line.substr(i, end - i)});
      break;
    }
    const auto run = [&](auto fits) {
      while (end < line.size() && fits(line[end]))
        ++end;
    };
    if (begins_name(c)) {
      run(is_name_char);
      kind = find_word(line.substr(i, end - i)).kind == WordKind::Name ? TokenKind::Name
                                                                       : TokenKind::Word;
    } else if (is_digit(c) || colour) {
      run([](char d) { return is_name_char(d) || d == '.'; });
      kind = TokenKind::Number;
    } else if (c == '"') {
      run([](char d) { return d != '"'; });
      end = std::min(end + 1, line.size());
      kind = TokenKind::Text;
    } else if (end < line.size()) {
      const auto two = line.substr(i, 2);
      for (const auto* sign :
           {"<>", "<=", ">=", "!=", "==", "+=", "-=", "*=", "/=", "%=", "&&", "||"})
        if (two == sign)
          end = i + 2;
    }
    tokens.push_back({kind, line.substr(i, end - i)});
    i = end;
  }
  return tokens;
}

bool is_sign(const Token& token, std::string_view signs) {
  return token.kind == TokenKind::Sign && token.text.size() == 1 &&
         signs.find(token.text) != std::string_view::npos;
}

/// True if the token ends an operand, so that a minus sign after it is an operator.
bool ends_operand(const Token& token) {
  if (token.kind == TokenKind::Word) {
    const auto kind = find_word(token.text).kind;
    return kind == WordKind::Variable;
  }
  return token.kind == TokenKind::Name || token.kind == TokenKind::Number ||
         token.kind == TokenKind::Text || is_sign(token, ")]");
}

bool calls(const Token& token) {
  if (token.kind == TokenKind::Name)
    return true;
  return token.kind == TokenKind::Word && is_function(find_word(token.text));
}

class Layout {
public:
  explicit Layout(const Program& program)
      : program_(program),
        text_(std::string_view(program.text).substr(0, program.files.front().end)) {}

  std::vector<LaidLine> run() {
    std::uint32_t next = 0; // the next statement
    bool blank_pending = false;
    bool inside = false; // the line continues the one before
    for (auto at = byte_order_mark_size(text_); at < text_.size();) {
      auto end = at;
      while (end < text_.size() && !is_line_end(text_[end]))
        ++end;
      const auto tokens = tokens_of(text_.substr(at, end - at));
      if (tokens.empty()) {
        blank_pending = blank_pending || (!lines_.empty() && !inside);
      } else {
        auto& line = lines_.emplace_back();
        line.source = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)};
        line.after_blank = std::exchange(blank_pending, false);
        line.statements_begin = next;
        const auto level = begin_statements(next, end);
        const bool starts = next > line.statements_begin;
        while (line.statements_begin < next && ends_line(line.statements_begin))
          ++line.statements_begin;
        line.statements_end = next;
        line.level = starts ? level : inside ? level_ + 2 : level_;
        line.around = level_;
        write(tokens, line);
        inside = goes_on(tokens, inside && !starts);
      }
      at = end + (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n' ? 2 : 1);
    }
    return std::move(lines_);
  }

private:
  /// Skips the statements that begin before `end`; returns the level of the first of them.
  std::size_t begin_statements(std::uint32_t& next, std::size_t end) {
    std::size_t level = level_;
    bool first = true;
    for (; next < program_.statements.size() && program_.statements[next].span.begin < end;
         ++next) {
      const auto& statement = program_.statements[next];
      if (ends_line(next))
        continue;
      const auto opener =
          statement.opener == none ? Kind::Broken : program_.statements[statement.opener].kind;
      const bool closes = statement.opener != none && statement.next == none;
      const bool parts = statement.opener != none && statement.next != none;
      const std::size_t width = opener == Kind::Select ? 2 : 1;
      auto own = level_;
      if (closes && !statement.one_line)
        own = level_ = level_ - std::min(level_, width);
      else if (parts && !statement.one_line)
        own = level_ - std::min<std::size_t>(level_, 1);
      if (first)
        level = own;
      first = false;
      if (statement.opener == none && statement.next != none && !statement.one_line)
        level_ += statement.kind == Kind::Select ? 2 : 1;
    }
    return level;
  }

  /// True if the statement only ends a one-line `if`.
  bool ends_line(std::uint32_t i) const {
    return program_.statements[i].kind == Kind::EndIf && program_.statements[i].one_line;
  }

  /// True if the statement continues on the next line.
  bool goes_on(const std::vector<Token>& tokens, bool inside) {
    const Token* last = nullptr;
    for (const auto& token : tokens) {
      if (token.kind == TokenKind::Comment)
        break;
      last = &token;
      if (is_sign(token, "(["))
        ++brackets_;
      if (is_sign(token, ")]") && brackets_ > 0)
        --brackets_;
    }
    if (last == nullptr)
      return inside;
    const auto word = find_word(last->text);
    const bool joins =
        last->kind == TokenKind::Word && (word.is(Keyword::And) || word.is(Keyword::Or));
    const bool sign = last->kind == TokenKind::Sign && !is_sign(*last, ")];:?${}");
    const bool on = brackets_ > 0 || joins || sign;
    if (!on)
      brackets_ = 0;
    return on;
  }

  void write(const std::vector<Token>& tokens, LaidLine& line) const {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].kind == TokenKind::Comment)
        break;
      if (i > 0 && !joined(tokens, i))
        line.text += ' ';
      line.text += spelled(tokens[i]);
    }
    line.code = line.text.size();
    const auto last = tokens.size() - 1;
    if (tokens[last].kind != TokenKind::Comment)
      return;
    if (last > 0 && !joined(tokens, last))
      line.text += ' ';
    line.text += tokens[last].text;
  }

  std::string_view spelled(const Token& token) const {
    return token.kind == TokenKind::Word   ? documented(token.text)
           : token.kind == TokenKind::Name ? first_spelling(program_, token.text)
                                           : token.text;
  }

  /// True if there is no space before token `i`.
  static bool joined(const std::vector<Token>& tokens, std::size_t i) {
    const auto& token = tokens[i];
    const auto& before = tokens[i - 1];
    if (is_sign(token, "),];:") || is_sign(before, "([$"))
      return true;
    if (is_sign(token, "["))
      return before.kind == TokenKind::Name;
    if (is_sign(token, "("))
      return calls(before);
    return is_sign(before, "-") && !(i >= 2 && ends_operand(tokens[i - 2]));
  }

  const Program& program_;
  std::string_view text_;
  std::vector<LaidLine> lines_;
  std::size_t level_ = 0;
  std::size_t brackets_ = 0;
};

} // namespace

std::vector<LaidLine> lay_out(const Program& program) {
  return Layout(program).run();
}

std::string_view first_spelling(const Program& program, std::string_view name) {
  for (const auto span : program.names)
    if (equal_words(program.text_of(span), name))
      return program.text_of(span);
  return name;
}

std::string_view documented(std::string_view word) {
  const auto spelled = spelling(find_word(word));
  return equal_words(spelled, word) ? spelled : word;
}

} // namespace orb::structured
