#include "repair/normalise.h"

#include "base/text/text.h"

#include <algorithm>
#include <string>
#include <string_view>

// Quotes, brackets, operators and numbers of other languages.

namespace orb::repair {
/// `"touches no wall'`: a text closed by another quote.
void close_text(Line& line) {
  if (line.tokens.empty() || !line.tokens.back().is_text() || line.tokens.back().closed)
    return;
  auto& text = line.tokens.back();
  const auto end = text.text.find_last_not_of(":,;");
  if (end == std::string::npos || end == 0 || text.text[end] != '\'')
    return;
  text.text.resize(end);
  text.closed = true;
}

/// `make "side :side + 5` and `setpc "blue`: Logo words have only an opening quote.
void words_with_one_quote(Line& line) {
  auto& tokens = line.tokens;
  const auto size = tokens.size();
  if (size < 2 || !tokens[size - 1].is_text() || tokens[size - 1].closed ||
      !holds("make go setpc setpencolor setcolor setcolour", tokens[size - 2].text))
    return;
  auto rest = tokens_of(tokens[size - 1].text, line.language());
  if (!rest.empty())
    rest[0].gap = true;
  tokens.pop_back();
  append(tokens, rest);
}

/// `if :n > 3`: Logo values.
void drop_colons(Line& line) {
  auto& tokens = line.tokens;
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
    const auto& before = tokens[i - 1];
    const bool printed = tokens[0].is("print") && before.is_text(); // `print "F(" :N`
    const bool operand = before.is_number() || before.is(")") || before.is("]") ||
                         (before.is_text() && !printed) ||
                         (before.is_word() && before.text.size() == 1);
    if (tokens[i].is(":") && tokens[i].gap && !operand && tokens[i + 1].is_word() &&
        !tokens[i + 1].gap && !before.is("else") && !before.is("then"))
      take_out(tokens, i, 1);
  }
}

/// Operators of the C family.
void plain_signs(Line& line) {
  for (std::size_t i = 2; i + 1 < line.tokens.size(); ++i) { // `60 plus tilt`
    auto& token = line.tokens[i];
    if (line.is_program() && token.is("percent") && line.is_unknown(token) &&
        !line.tokens[0].is("print") &&
        (line.is_variable(line.tokens[i - 1]) || line.tokens[i - 1].is(")")))
      token = Token{Token::Kind::Sign, "%", true}; // `n percent d`
    if (line.is_program() && (token.is("plus") || token.is("minus")) &&
        !line.has_name(token.text) && !line.tokens[i - 1].is("=") && !line.tokens[0].is("print"))
      token = Token{Token::Kind::Sign, token.is("plus") ? "+" : "-", true};
  }
  for (auto& token : line.tokens)
    if (token.is("==") || token.is("===")) {
      token.text = "=";
    } else if (token.is("!==")) {
      token.text = "!=";
    } else if (token.is("&&") || token.is("||")) {
      token.kind = Token::Kind::Word;
      token.text = token.is("&&") ? "and" : "or";
      token.gap = true;
    }
}

/// `sub drive(time as integer)` and `sub bar(length in steps)`: parameters are numbers, so the
/// types are dropped.
void drop_types(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 6 || !holds("sub function def to", tokens[0].text) || !tokens[2].is("("))
    return;
  tokens[2].gap = false;
  for (std::size_t i = 4; i + 2 < tokens.size(); ++i) {
    const bool ends = tokens[i + 2].is(",") || tokens[i + 2].is(")");
    if (!ends || !(holds("as in", tokens[i].text) || tokens[i].is(":")) || !tokens[i + 1].is_word())
      continue;
    tokens[i + 2].gap = false;
    tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                 tokens.begin() + static_cast<std::ptrdiff_t>(i) + 2);
  }
}

/// `for B = 1 to 1.000`: a thousands separator, common in Europe.
void read_thousands(Line& line) {
  constexpr std::string_view thousand = ".000";
  auto& tokens = line.tokens;
  if (tokens.empty() || holds("delay wait sleep pause", tokens[0].text))
    return;
  for (auto& token : tokens)
    if (token.is_number() && token.text.size() > thousand.size() && token.text.ends_with(thousand))
      token.text.erase(token.text.size() - thousand.size(), 1);
}

/// `values(3)` of an array becomes `values[3]`.
void index_arrays(Line& line) {
  auto& tokens = line.tokens;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    if (!tokens[i].is("(") || !tokens[i - 1].is_word() ||
        !line.scenery->is_array(tokens[i - 1].text))
      continue;
    const auto end = close_of(tokens, i);
    if (end == tokens.size())
      return;
    tokens[i].text = "[";
    tokens[i].gap = false;
    tokens[end].text = "]";
  }
}

/// A single `]`, next to the key of `}`.
void close_block(Line& line) {
  if (line.tokens.size() == 1 && line.tokens[0].is("]"))
    line.tokens[0].text = "}";
}

/// `if open = "true"`: a truth value needs no comparison if the language takes a bare name.
void compare_with_true(Line& line) {
  auto& tokens = line.tokens;
  const bool test = line.language() == Language::Test;
  const bool bare = test || line.language() == Language::Structured;
  for (std::size_t i = 3; i < tokens.size(); ++i) {
    if (!(tokens[i].is_text() || test) || !tokens[i - 1].is_relation())
      continue;
    if (equal_words(tokens[i].text, "true") && bare && tokens[i - 1].is("=")) {
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i) - 1,
                   tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      i -= 2;
    } else if (equal_words(tokens[i].text, "true") || equal_words(tokens[i].text, "false")) {
      tokens[i].kind = Token::Kind::Word;
    }
  }
}

/// `A% = B%`: type suffixes of variables.
void drop_sigils(Line& line) {
  auto& tokens = line.tokens;
  const auto names_variable = [&](const Token& token) {
    return token.is_word() && (token.text.size() == 1 || (line.language() == Language::Structured &&
                                                          line.is_elsewhere(token.text)));
  };
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i) // `print "macro", #M`
    if (tokens[i].is("#") && tokens[i - 1].is(",") && !tokens[i + 1].gap)
      take_out(tokens, i, 1);
  if (tokens.size() > 2 && tokens[0].text.size() == 1 && tokens[1].is("#") &&
      tokens[2].is("=")) // `B# = Q`
    take_out(tokens, 1, 1);
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i) // `STR$(F)`
    if (tokens[i].is("$") && !tokens[i].gap && tokens[i - 1].is_word() && tokens[i + 1].is("("))
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i));
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    const bool sigil =
        !tokens[i].gap && (tokens[i].is("%") || tokens[i].is("&") || tokens[i].is("!"));
    const bool operand =
        i + 1 < tokens.size() &&
        (tokens[i + 1].is_number() || tokens[i + 1].is_word() || tokens[i + 1].is("("));
    if (sigil && !operand && names_variable(tokens[i - 1]))
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i--));
  }
}

/// Converts `0x` numbers to decimal.
void decimal_numbers(Line& line) {
  for (auto& token : line.tokens)
    if (token.is_number() && token.text.size() > 2 && to_lower(token.text[1]) == 'x')
      if (const auto value = parse_number<std::int32_t>(std::string_view(token.text).substr(2), 16))
        token.text = std::to_string(*value);
}

} // namespace orb::repair
