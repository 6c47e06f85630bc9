#include "repair/tokens.h"

#include "base/text/text.h"

#include <algorithm>
#include <array>

namespace orb::repair {
namespace {

bool is_part(char c) {
  return is_letter(c) || is_digit(c) || c == '_' || static_cast<unsigned char>(c) >= 0xC3;
}
struct Written {
  std::string_view text;
  std::string_view means;
};

/// Multi-byte signs and their keyboard equivalents.
constexpr auto drawn = std::to_array<Written>(
    {{"×", "*"},  {"÷", "/"},  {"≤", "<="}, {"≥", ">="}, {"≠", "!="}, {"–", "-"},   {"−", "-"},
     {"·", "*"},  {"←", "="},  {"→", "->"}, {"…", ".."}, {"±", "+-"}, {"°", "deg"}, {"º", "deg"},
     {"，", ","}, {"、", ","}, {"．", "."}, {"：", ":"}, {"；", ";"}, {"（", "("},  {"）", ")"},
     {"＝", "="}, {"＜", "<"}, {"＞", ">"}, {"＋", "+"}, {"－", "-"}, {"＊", "*"},  {"／", "/"}});
constexpr auto quotes = std::to_array<std::string_view>(
    {"“", "”", "„", "＂", "‟", "«", "»", "‘", "’", "‚", "''", "``", "´", "`", "'", "\""});
constexpr auto long_signs = std::to_array<std::string_view>(
    {"===", "!==", "...", "+-", "==", "!=", "<>", "<=", ">=", "=<", "=>",
     "+=",  "-=",  "*=",  "/=", "%=", "=+", "=-", "++", "--", "&&", "||",
     ":=",  "<-",  "**",  "//", "->", "<<", ">>", "..", "~="});

/// True if a sign outside ASCII may begin with this byte.
bool may_draw(char c) {
  constexpr unsigned char first = 0xC2; // the lowest first byte
  return static_cast<unsigned char>(c) >= first;
}
bool may_quote(char c) {
  return c == '"' || c == '\'' || c == '`' || may_draw(c);
}

class Splitter {
public:
  Splitter(std::string_view text, Language language) : text_(text), language_(language) {}

  SplitLine whole() {
    SplitLine line;
    blanks();
    if (language_ == Language::Basic) {
      const auto digits = at_;
      while (at_ < text_.size() && is_digit(text_[at_]))
        ++at_;
      if (at_ > digits)
        blanks();
    }
    line.head = text_.substr(0, at_);
    line.tokens = rest();
    line.comment = std::move(comment_);
    return line;
  }

  Tokens rest() {
    Tokens tokens;
    tokens.reserve(text_.size() / 3); // words and their spaces are longer, signs shorter
    while (true) {
      const auto before = at_;
      blanks();
      gap_ = at_ > before;
      if (immediate_here(tokens))
        ++at_;
      if (at_ == text_.size() || comment(tokens))
        return tokens;
      start_ = at_;
      if (!text(tokens) && !number(tokens) && !word(tokens))
        sign(tokens);
    }
  }

private:
  /// The size of a character that looks like a space or is invisible; 0 if there is none here.
  std::size_t special_blank() const {
    constexpr auto special = std::to_array<std::string_view>(
        {"\u00A0", "\u00AD", "\u2002", "\u2003", "\u2009", "\u200B", "\u200C", "\u200D", "\u202F",
         "\u2060", "\u3000", "\uFEFF"});
    if (!may_draw(text_[at_]))
      return 0;
    const auto* const found = std::find_if(special.begin(), special.end(),
                                           [&](std::string_view one) { return sees(one); });
    return found == special.end() ? 0 : found->size();
  }
  void blanks() {
    while (at_ < text_.size()) {
      const auto size = is_blank(text_[at_]) ? 1 : special_blank();
      if (size == 0)
        return;
      at_ += size;
    }
  }
  bool sees(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  void add(Tokens& tokens, Token::Kind kind, std::string text) const {
    Token token;
    token.kind = kind;
    token.text = std::move(text);
    token.gap = gap_;
    token.at = static_cast<std::uint32_t>(start_);
    tokens.push_back(std::move(token));
  }

  bool comment(const Tokens& tokens) {
    std::size_t sign = 0;
    if (sees("//") && (tokens.empty() || gap_) && !divides(tokens))
      sign = 2;
    else if (sees("/*"))
      sign = 2;
    else if (sees("--") && at_ + 3 < text_.size() && is_blank(text_[at_ + 2]) &&
             (tokens.empty() || (gap_ && is_letter(text_[at_ + 3]))))
      sign = 2;
    else if (sees("#") && !colour_here() && !begins_value(tokens) && !is_number_sign(tokens) &&
             !(tokens.empty() && (sees("#include") || sees("#define"))))
      sign = 1;
    else if (sees(";") && language_ == Language::Macro && (tokens.empty() || gap_))
      sign = 1;
    else if (sees("'") && !quoted_here(tokens))
      sign = 1;
    else if (tokens.empty() && text_.size() >= at_ + 3 &&
             equal_words(text_.substr(at_, 3), "rem") &&
             (at_ + 3 == text_.size() || !is_part(text_[at_ + 3])))
      sign = 3;
    if (sign == 0)
      return false;
    auto said = text_.substr(at_ + sign);
    if (said.ends_with("*/"))
      said.remove_suffix(2);
    while (!said.empty() && is_blank(said.front()))
      said.remove_prefix(1);
    while (!said.empty() && is_blank(said.back()))
      said.remove_suffix(1);
    const bool hash = language_ == Language::Macro || language_ == Language::Test;
    const bool kept = language_ == Language::Macro && sees(";");
    comment_ = (kept ? "; " : hash ? "# " : "' ") + std::string(said);
    if (said.empty())
      comment_.pop_back();
    at_ = text_.size();
    return true;
  }

  /// `gosub #200` and `print #2A` in programs.
  bool is_number_sign(const Tokens& tokens) const {
    return (language_ == Language::Basic || language_ == Language::Structured) && !tokens.empty() &&
           at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
  }

  /// `A // 2`: a division, not a comment.
  bool divides(const Tokens& tokens) const {
    const auto next = text_.find_first_not_of(" \t", at_ + 2);
    if (tokens.size() < 2 || next == std::string_view::npos)
      return false;
    const auto opened =
        std::count_if(tokens.begin(), tokens.end(), [](const Token& one) { return one.is("("); });
    if (opened >
        std::count_if(tokens.begin(), tokens.end(), [](const Token& one) { return one.is(")"); }))
      return true; // its partner follows
    const auto end = text_.find_first_of(" \t),", next);
    const auto word = text_.substr(next, end == std::string_view::npos ? end : end - next);
    return std::all_of(word.begin(), word.end(), is_digit) ||
           (word.size() == 1 && end == std::string_view::npos);
  }

  /// True if a value must follow: `, #M` and `id=#28` are not comments.
  static bool begins_value(const Tokens& tokens) {
    return !tokens.empty() && (tokens.back().is(",") || tokens.back().is("="));
  }

  bool colour_here() const {
    std::size_t digits = 0;
    while (at_ + 1 + digits < text_.size() &&
           std::string_view("0123456789abcdefABCDEF").find(text_[at_ + 1 + digits]) !=
               std::string_view::npos)
      ++digits;
    return (digits == 6 || digits == 3) &&
           (at_ + 1 + digits == text_.size() || !is_part(text_[at_ + 1 + digits]));
  }

  /// True for a colour that cannot be a number: with letters, or of six digits.
  bool long_colour_here() const {
    constexpr std::size_t short_ = 3;
    const auto end = text_.find_first_not_of("0123456789", at_ + 1);
    const auto digits = std::min(end, text_.size()) - at_ - 1;
    return colour_here() && digits != short_;
  }

  /// `#90`, an immediate number of assemblers; a comment does not begin like this.
  bool immediate_here(const Tokens& tokens) const {
    const auto digit =
        at_ + (text_.substr(std::min(at_ + 1, text_.size())).starts_with('-') ? 2 : 1);
    const bool id =
        tokens.size() > 1 && tokens.back().is("=") && tokens[tokens.size() - 2].is("id");
    return language_ == Language::Macro && sees("#") && !tokens.empty() && !id &&
           digit < text_.size() && is_digit(text_[digit]) && !long_colour_here();
  }

  /// True for a `'` that begins a text: it is closed later and a value is expected here.
  bool quoted_here(const Tokens& tokens) const {
    const auto close = text_.find('\'', at_ + 1);
    if (language_ == Language::Test &&
        text_.find_first_of("'\"", at_ + 1) != std::string_view::npos)
      return true; // comments begin with `#` there
    if (close == std::string_view::npos || tokens.empty())
      return false;
    const auto& last = tokens.back();
    return last.is("(") || last.is("~") || last.is(",") || last.is("+") || last.is("=") ||
           last.is("==") || text_[at_ + 1] == '\'' || (last.is_word() && tokens.size() <= 3);
  }

  bool text(Tokens& tokens) {
    if (!may_quote(text_[at_]))
      return false;
    const auto quote =
        std::find_if(quotes.begin(), quotes.end(), [&](std::string_view one) { return sees(one); });
    if (quote == quotes.end())
      return false;
    at_ += quote->size();
    const bool mixed = language_ == Language::Test && *quote == "'" &&
                       text_.find('\'', at_) == std::string_view::npos; // `'4 corners"`
    const bool straight = !mixed && (*quote == "\"" || *quote == "'");
    std::size_t end = std::string_view::npos;
    std::size_t width = 1;
    for (auto at = at_; at < text_.size() && end == std::string_view::npos; ++at)
      for (const auto one : quotes)
        if (may_quote(text_[at]) && text_.substr(at).starts_with(one) &&
            (straight ? one == *quote : one != "'")) {
          end = at;
          width = one.size();
          break;
        }
    add(tokens, Token::Kind::Text,
        std::string(text_.substr(at_, end == std::string_view::npos ? end : end - at_)));
    auto& token = tokens.back();
    token.closed = end != std::string_view::npos;
    token.plain = *quote == "\"";
    at_ = token.closed ? end + width : text_.size();
    if (*quote == "«")
      token.text = trim(std::string(token.text)); // French quotes have inner spaces
    if (!token.closed)
      while (!token.text.empty() && is_blank(token.text.back()))
        token.text.pop_back();
    return true;
  }

  void digits() {
    while (at_ < text_.size() && is_digit(text_[at_]))
      ++at_;
  }

  bool number(Tokens& tokens) {
    if (!is_digit(text_[at_]) &&
        !(text_[at_] == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]) &&
          (tokens.empty() || !tokens.back().is_number())))
      return false;
    const auto begin = at_;
    if (sees("0x") || sees("0X")) {
      at_ += 2;
      while (at_ < text_.size() && is_part(text_[at_]))
        ++at_;
    } else {
      digits();
      const auto point = at_;
      const bool after_point = !gap_ && !tokens.empty() && tokens.back().is(".");
      if (sees(".") && !after_point && at_ + 1 < text_.size() && is_digit(text_[at_ + 1])) {
        ++at_;
        digits();
        if (sees(".") && !sees("..") && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))
          at_ = point; // `255.0.0`: points for commas
      }
    }
    add(tokens, Token::Kind::Number, std::string(text_.substr(begin, at_ - begin)));
    return true;
  }

  bool is_drawn() const {
    return may_draw(text_[at_]) && std::any_of(drawn.begin(), drawn.end(),
                                               [&](const Written& one) { return sees(one.text); });
  }

  bool word(Tokens& tokens) {
    if (!is_part(text_[at_]) &&
        !(text_[at_] == '.' && language_ == Language::Macro && tokens.empty()))
      return false;
    if (is_drawn())
      return false;
    const auto begin = at_++;
    constexpr std::string_view until = "jusqu'"; // the only word with such a sign
    if (text_.substr(begin).starts_with(until))
      at_ += until.size() - 1;
    while (at_ < text_.size() && (is_part(text_[at_]) || is_utf8_tail(text_[at_])) && !is_drawn() &&
           special_blank() == 0)
      ++at_;
    add(tokens, Token::Kind::Word, std::string(text_.substr(begin, at_ - begin)));
    return true;
  }

  void sign(Tokens& tokens) {
    if (sees("#") && colour_here()) {
      const auto begin = at_++;
      while (at_ < text_.size() && is_part(text_[at_]))
        ++at_;
      return add(tokens, Token::Kind::Colour, std::string(text_.substr(begin, at_ - begin)));
    }
    for (const auto& one : drawn)
      if (may_draw(text_[at_]) && sees(one.text)) {
        at_ += one.text.size();
        return add(tokens, is_letter(one.means[0]) ? Token::Kind::Word : Token::Kind::Sign,
                   std::string(one.means));
      }
    const bool two = sees("<-") && !gap_; // `x<-90`
    for (const auto one : long_signs)
      if (sees(one) && !two) {
        at_ += one.size();
        return add(tokens, Token::Kind::Sign, std::string(one));
      }
    add(tokens, Token::Kind::Sign, std::string(text_.substr(at_, 1)));
    ++at_;
  }

  std::string_view text_;
  Language language_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;
  bool gap_ = false;
  std::string comment_;
};

} // namespace

bool Token::is_relation() const {
  constexpr auto signs = std::to_array<std::string_view>(
      {"=", "!", "<", ">", "<=", ">=", "==", "!=", "<>", "=>", "=<"});
  return std::find(signs.begin(), signs.end(), text) != signs.end() && !is_text();
}

SplitLine split(std::string_view line, Language language) {
  return Splitter(line, language).whole();
}

Tokens tokens_of(std::string_view text, Language language) {
  return Splitter(text, language).rest();
}

std::string join(const Tokens& tokens) {
  std::string line;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto& token = tokens[i];
    const bool letters = i > 0 && !line.empty() && is_part(line.back()) && !token.is_text() &&
                         is_part(token.text.empty() ? ' ' : token.text[0]) &&
                         !tokens[i - 1].is_number();
    if (i > 0 && (token.gap || letters))
      line += ' ';
    line += token.is_text() ? '"' + token.text + '"' : token.text;
  }
  return line;
}

std::string join(const SplitLine& line) {
  auto text = line.head + join(line.tokens);
  if (!line.comment.empty())
    text += (line.tokens.empty() ? "" : " ") + line.comment;
  return text;
}

bool has_token(const Tokens& tokens, std::string_view text) {
  return std::any_of(tokens.begin(), tokens.end(),
                     [&](const Token& token) { return token.is(text); });
}

Tokens slice(const Tokens& tokens, std::size_t begin, std::size_t end) {
  end = std::min(end, tokens.size());
  const auto at = tokens.begin();
  return {at + static_cast<std::ptrdiff_t>(std::min(begin, end)),
          at + static_cast<std::ptrdiff_t>(end)};
}

std::size_t close_of(const Tokens& tokens, std::size_t open) {
  if (open >= tokens.size())
    return tokens.size();
  const std::string_view opening = tokens[open].text;
  const auto closing = opening == "(" ? ")" : opening == "[" ? "]" : "}";
  int depth = 0;
  for (auto at = open; at < tokens.size(); ++at) {
    depth += tokens[at].is(opening) ? 1 : tokens[at].is(closing) ? -1 : 0;
    if (depth == 0)
      return at;
  }
  return tokens.size();
}

bool looks_like_digits(std::string_view word) {
  return word.find_first_not_of("oOlI") == std::string_view::npos;
}

std::string as_digits(std::string text) {
  for (auto& c : text)
    c = c == 'l' || c == 'I' ? '1' : c == 'O' || c == 'o' ? '0' : c;
  return text;
}

Token word(std::string_view text) {
  return Token{Token::Kind::Word, std::string(text), true};
}

void take_out(Tokens& tokens, std::size_t at, std::size_t count) {
  const auto first = tokens.begin() + static_cast<std::ptrdiff_t>(at);
  if (at + count < tokens.size())
    tokens[at + count].gap = first->gap;
  tokens.erase(first, first + static_cast<std::ptrdiff_t>(count));
}

void append(Tokens& to, const Tokens& tokens) {
  to.insert(to.end(), tokens.begin(), tokens.end());
}

std::vector<std::string> parts_of(std::string_view word) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool capital =
        i > 0 && to_lower(word[i]) != word[i] && to_lower(word[i - 1]) == word[i - 1];
    if ((word[i] == '_' || capital) && !parts.back().empty())
      parts.emplace_back();
    if (word[i] != '_')
      parts.back() += to_lower(word[i]);
  }
  return parts;
}

} // namespace orb::repair
