#include "repair/normalise.h"

#include "base/text/text.h"
#include "repair/colours.h"
#include "repair/units.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

// Quotes, brackets, operators and numbers as other languages write them.

namespace orb::repair {
/// Whether a text ends in a comma and a name: `"yes! in, tries "`.
bool ends_in_name(const Line& line, const Token& text) {
  const auto comma = text.text.rfind(',');
  if (!text.is_text() || comma == std::string::npos)
    return false;
  const auto name = trim(std::string_view(text.text).substr(comma + 1));
  return line.has_name(name) || (line.language() == Language::Basic && name.size() == 1);
}

/// `"touches no wall'`: a text that another quote closes.
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

/// `warned = "False"`: what is true is 1.
void truths(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() == 2 && holds("while until if", tokens[0].text) && tokens[1].is_text() &&
      holds("true false", tokens[1].text))
    tokens[1].kind = Token::Kind::Word; // `While "True"`
  if (tokens.size() != 3 || !tokens[1].is("=") || !tokens[2].is_text() ||
      !holds("true false", tokens[2].text))
    return;
  tokens[2].kind = Token::Kind::Number;
  tokens[2].text = equal_words(tokens[2].text, "true") ? "1" : "0";
}

/// `DATA "222","121"` and `RGB("0,255,0")`: neither takes a text.
void numbers_in_quotes(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.empty() || !(tokens[0].is("data") || tokens[0].is("RGB")))
    return;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    const std::string_view said = tokens[i].text;
    if (!tokens[i].is_text() || said.empty() || !is_digit(said[0]) ||
        said.find_first_not_of("0123456789, ") != std::string_view::npos)
      continue;
    const auto values = tokens_of(said, line.language());
    const auto at = tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i));
    tokens.insert(at, values.begin(), values.end());
  }
}

/// `state = "open"` where the program has `open`.
void names_in_quotes(Line& line) {
  auto& tokens = line.tokens;
  if (has_token(tokens, "print"))
    return;
  for (std::size_t i = 1; i < tokens.size(); ++i)
    if (tokens[i].is_text() && tokens[i - 1].is_relation() && line.has_name(tokens[i].text))
      tokens[i].kind = Token::Kind::Word;
}

/// `print [longest hold] :longest`: the texts of Logo have brackets.
void texts_in_brackets(Line& line) {
  auto& tokens = line.tokens;
  const std::size_t print = tokens.size() > 2 && tokens[0].is("(") ? 1 : 0;
  for (std::size_t i = print + 1; i < tokens.size() && tokens[print].is("print"); ++i) {
    const auto close = tokens[i].is("[") && tokens[i].gap ? close_of(tokens, i) : tokens.size();
    if (close == tokens.size() || close < i + 2 || !tokens[i + 1].is_word())
      continue;
    const Token text{Token::Kind::Text, join(slice(tokens, i + 1, close)), true};
    const auto at = tokens.begin() + static_cast<std::ptrdiff_t>(i);
    tokens.insert(tokens.erase(at, tokens.begin() + static_cast<std::ptrdiff_t>(close) + 1), text);
  }
}

/// `make "side :side + 5` and `setpc "blue`: the words of Logo have one quote.
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

/// `if :n > 3`: values of Logo.
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

/// `ifelse :up [floor = 1] [floor = 2]`: the branches of Logo.
void read_branches(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.empty() || !holds("if ifelse when", tokens[0].text))
    return;
  std::size_t open = 2;
  while (open < tokens.size() && !(tokens[open].is("[") && tokens[open].gap))
    ++open;
  const auto close = close_of(tokens, open);
  if (close >= tokens.size() || close < open + 3)
    return; // an index
  if (close + 1 < tokens.size()) {
    if (!tokens[close + 1].is("[") || close_of(tokens, close + 1) + 1 != tokens.size())
      return;
    tokens[close + 2].gap = true;
    tokens.pop_back();
    tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(close));
    tokens[close] = word("else");
  } else {
    tokens.pop_back();
  }
  tokens[open + 1].gap = true;
  tokens[open] = word("then");
  tokens[0].text = "if";
}

/// `for n = #4E to #62`: as soon as one has a letter they are hexadecimal.
void read_hexadecimal(Line& line) {
  auto& tokens = line.tokens;
  struct Number {
    std::size_t at = 0;
    std::size_t parts = 0;
    std::string digits;
  };
  constexpr std::size_t longest = 4;
  std::vector<Number> found;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (!tokens[i].is("#"))
      continue;
    Number number{i, 0, {}};
    for (auto next = i + 1; next < tokens.size() && !tokens[next].gap &&
                            (tokens[next].is_word() || tokens[next].is_number());
         ++next, ++number.parts)
      number.digits += tokens[next].text;
    if (number.digits.size() > 1 && number.digits.size() <= longest &&
        number.digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos)
      found.push_back(number);
  }
  if (std::all_of(found.begin(), found.end(), [](const Number& number) {
        return number.digits.find_first_not_of("0123456789") == std::string::npos;
      }))
    return;
  for (auto number = found.rbegin(); number != found.rend(); ++number) {
    tokens[number->at] =
        Token{Token::Kind::Number, std::to_string(*parse_number<int>(number->digits, 16)),
              tokens[number->at].gap};
    const auto first = tokens.begin() + static_cast<std::ptrdiff_t>(number->at) + 1;
    tokens.erase(first, first + static_cast<std::ptrdiff_t>(number->parts));
  }
}

/// Brackets and colons that others need: `(print :a :b)`, `call show[]`, `Y += 5 }`, `60: P = 1`.
void drop_brackets(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 3)
    return;
  if (tokens[0].is("(") && tokens.back().is(")") && holds("print type show pr", tokens[1].text)) {
    tokens.pop_back();
    take_out(tokens, 0, 1);
  }
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
    if (tokens[i].is("[") && tokens[i + 1].is("]") && line.has_name(tokens[i - 1].text) &&
        !line.knows(tokens[i - 1].text)) {
      tokens[i].text = "(";
      tokens[i + 1].text = ")";
    }
  if (tokens.back().is("}") && !tokens[tokens.size() - 2].is(";") && !has_token(tokens, "{"))
    tokens.insert(tokens.end() - 1, Token{Token::Kind::Sign, ";"});
  if (line.language() == Language::Basic && tokens[0].is(":")) {
    line.head += " ";
    tokens.erase(tokens.begin());
  }
}

/// Operators of C and its children, which every such line has.
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

/// `sub drive(time as integer)` and `sub bar(length in steps)`: parameters are numbers.
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

/// `for B = 1 to 1.000`: thousands, as half of Europe parts them.
void read_thousands(Line& line) {
  constexpr std::string_view thousand = ".000";
  auto& tokens = line.tokens;
  if (tokens.empty() || holds("delay wait sleep pause", tokens[0].text))
    return;
  for (auto& token : tokens)
    if (token.is_number() && token.text.size() > thousand.size() && token.text.ends_with(thousand))
      token.text.erase(token.text.size() - thousand.size(), 1);
}

/// `RGB 0, 60%, 30%` in parts of 255.
void count_percents(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.empty() || !tokens[0].is("RGB"))
    return;
  const bool parts = std::all_of(tokens.begin() + 1, tokens.end(), [](const Token& token) {
    const auto value = parse_number<double>(token.text, std::chars_format::fixed);
    return token.is(",") || (token.is_number() && value && *value <= 1);
  });
  const bool point = std::any_of(tokens.begin(), tokens.end(), [](const Token& token) {
    return token.text.find('.') != std::string::npos;
  });
  for (auto& token : tokens) // `RGB 0, 0.5, 1.0`
    if (parts && point && token.is_number())
      token.text = std::to_string(std::lround(
          parse_number<double>(token.text, std::chars_format::fixed).value_or(0) * UINT8_MAX));
  const auto names = std::count_if(tokens.begin() + 1, tokens.end(),
                                   [](const Token& token) { return token.is_word(); });
  if (names == 3 && tokens.back().is_number()) // `RGB rosso 255, verde 110, blu 0`
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
      if (tokens[i].is_word() && tokens[i + 1].is_number())
        take_out(tokens, i, 1);
  for (std::size_t i = 2; i < tokens.size(); ++i) {
    const auto value = parse_number<int>(tokens[i - 1].text);
    constexpr int all = 100;
    const bool ends = i + 1 == tokens.size() || tokens[i + 1].is(",") || tokens[i + 1].is(")") ||
                      tokens[i + 1].is("*") || tokens[i + 1].is("/");
    if (!tokens[i].is("%") || !tokens[i - 1].is_number() || !value || *value > all || !ends)
      continue;
    tokens[i - 1].text = std::to_string((*value * UINT8_MAX + all / 2) / all);
    tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// `A% = B%`: signs behind a variable that tell its type elsewhere.
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

/// `print "A is " A"`: the last quote is too many.
void drop_last_quote(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() > 2 && tokens.back().is_text() && !tokens.back().closed &&
      tokens.back().text.empty() &&
      std::any_of(tokens.begin(), tokens.end() - 1,
                  [](const Token& token) { return token.is_text(); }) &&
      !ends_in_name(line, tokens[1]))
    tokens.pop_back();
}

/// `]` alone, beside the key of `}`.
void close_block(Line& line) {
  if (line.tokens.size() == 1 && line.tokens[0].is("]"))
    line.tokens[0].text = "}";
}

/// `if open = "true"`: what is true needs no comparison, where the language takes a bare name.
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

/// Numbers without `0x`.
void decimal_numbers(Line& line) {
  for (auto& token : line.tokens)
    if (token.is_number() && token.text.size() > 2 && to_lower(token.text[1]) == 'x')
      if (const auto value = parse_number<std::int32_t>(std::string_view(token.text).substr(2), 16))
        token.text = std::to_string(*value);
}

} // namespace orb::repair
