#include "repair/normalise.h"

#include "base/text/text.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

// Slips of the hand: the key beside, the same key without its shift, a key that was not hit.

namespace orb::repair {
/// Digits typed for the signs on their keys: `next_of9n)`, `delay L 8 75`, `M 5 10`; and `m` for
/// the comma beside it.
void read_shifted(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 3)
    return;
  for (std::size_t i = 0; i < tokens.size() && line.count_of(")") > line.count_of("("); ++i) {
    const auto nine = tokens[i].is_word() ? tokens[i].text.find('9') : std::string::npos;
    if (nine == std::string::npos || nine == 0)
      continue;
    auto rest = tokens_of(std::string_view(tokens[i].text).substr(nine + 1), line.language());
    tokens[i].text.resize(nine);
    rest.insert(rest.begin(), Token{Token::Kind::Sign, "("});
    tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest.begin(), rest.end());
  }
  const auto is_value = [&](const Token& token) {
    return token.is(")") || line.is_variable(token);
  };
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
    auto& token = tokens[i];
    const bool apart = token.gap && tokens[i + 1].gap;
    const bool operand =
        tokens[i + 1].is_number() || tokens[i + 1].is("(") || is_value(tokens[i + 1]);
    if ((token.is("8") || token.is("5")) && apart && operand && is_value(tokens[i - 1]) &&
        !tokens[0].is("print") && !tokens[0].is("data"))
      token = Token{Token::Kind::Sign, token.is("8") ? "*" : "%", true};
    const bool after_value = tokens[i - 1].is_text() || tokens[i - 1].is_number();
    if (token.is("m") && !token.gap && tokens[i + 1].gap && after_value &&
        (tokens[i + 1].is_number() || is_value(tokens[i + 1])))
      token = Token{Token::Kind::Sign, ","};
  }
}

/// `sub show(s0`: the bracket's key without its shift.
void close_by_key(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 3)
    return;
  auto& last = tokens.back();
  if (line.count_of("(") <= line.count_of(")") || last.text.size() < 2 ||
      !last.text.ends_with('0') || !last.is_word())
    return;
  const auto name = last.text.substr(0, last.text.size() - 1);
  if (line.has_name(last.text) || !(line.has_name(name) || holds("sub function", tokens[0].text)))
    return;
  last.text = name;
  tokens.push_back(Token{Token::Kind::Sign, ")"});
  line.incomplete = true;
}

/// `H.120` and `goroll T * 10.60,1`: a point for the comma beside it.
void comma_for_point(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 3)
    return;
  for (std::size_t i = 1; i < tokens.size() && holds("goroll RGB", tokens[0].text); ++i) {
    const auto point = tokens[i].text.find('.');
    const bool inside =
        point != std::string::npos && point > 0 && point + 1 < tokens[i].text.size();
    if (!inside || line.count_of(",") != 1 || !tokens[i].is_number())
      continue;
    auto second = tokens[i];
    second.text.erase(0, point + 1);
    tokens[i].text.resize(point);
    const auto next = tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    tokens.insert(next, {Token{Token::Kind::Sign, ","}, second});
    line.incomplete = true;
  }
  for (std::size_t i = 2; i < tokens.size(); ++i) {
    auto& token = tokens[i];
    const bool together = !token.gap && line.is_variable(tokens[i - 1]);
    if (together && token.is(".") && i + 1 < tokens.size() && tokens[i + 1].is_number()) {
      token.text = ",";
    } else if (together && token.is_number() && token.text.starts_with('.') &&
               token.text.size() > 1) {
      token.text.erase(0, 1);
      tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(i), Token{Token::Kind::Sign, ","});
    }
  }
}

namespace {

/// The sign that a statement lacks which begins at `at`: `C 0 C + 1`, `W + W / 2`, `N = N 1`.
void missed_sign(Line& line, std::size_t at) {
  auto& tokens = line.tokens;
  if (at + 2 >= tokens.size() || !line.is_variable(tokens[at]))
    return;
  const auto end = std::find_if(tokens.begin() + static_cast<std::ptrdiff_t>(at), tokens.end(),
                                [](const Token& token) { return token.is("else"); });
  const auto rest = tokens.begin() + static_cast<std::ptrdiff_t>(at) + 2;
  if (rest >= end)
    return;
  auto& sign = tokens[at + 1];
  const bool again =
      std::any_of(rest, end, [&](const Token& token) { return token.text == tokens[at].text; });
  const bool sets = std::any_of(rest - 1, end, [](const Token& token) { return token.is("="); });
  if (!sets && sign.gap && tokens[at + 2].gap && (sign.is("0") || (sign.is("+") && again))) {
    sign = Token{Token::Kind::Sign, "=", true};
    line.incomplete = true;
  } else if (sign.is("=") && end - rest > 2 && rest->text == tokens[at].text &&
             (rest + 1)->is("=")) {
    (rest + 1)->text = "+"; // `S = S = A * B`
    line.incomplete = true;
  } else if (sign.is("=") && end - rest == 2 && rest->text == tokens[at].text &&
             (rest + 1)->is_number() && (rest + 1)->gap) {
    tokens.insert(rest + 1, Token{Token::Kind::Sign, "+", true});
    line.incomplete = true;
  }
}

} // namespace

/// `if c then H = 270 H = 90`: two statements, of which the second is for the other case.
void missed_else(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.empty() || !tokens[0].is("if") || line.count_of("else") > 0)
    return;
  const auto then = std::find_if(tokens.begin(), tokens.end(),
                                 [](const Token& token) { return token.is("then"); });
  for (auto at = then; at != tokens.end() && tokens.end() - at > 2; ++at) {
    const bool begins = at - then > 3 && at->gap && line.is_variable(*at) && (at + 1)->is("=");
    if (!begins || !((at - 1)->is_number() || (at - 1)->is(")") || line.is_variable(*(at - 1))))
      continue;
    tokens.insert(at, word("else"));
    line.incomplete = true;
    return;
  }
}

/// `nex tB`, and `wait_for shake` in a program with `wait_for_shake`: a blank in the wrong place.
void join_words(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 2)
    return;
  if (line.language() == Language::Basic && tokens[0].is_word() && tokens[1].is_word() &&
      tokens[1].text.size() == 2 && line.knows(tokens[0].text + tokens[1].text[0])) {
    tokens[0].text += tokens[1].text[0];
    tokens[1].text.erase(0, 1);
  }
  for (std::size_t i = 0; i + 1 < tokens.size() && line.language() == Language::Structured; ++i) {
    const auto name = tokens[i].text + "_" + tokens[i + 1].text;
    if (!tokens[i].is_word() || !tokens[i + 1].is_word() || !line.has_name(name) ||
        line.knows(tokens[i].text))
      continue;
    tokens[i].text = name;
    take_out(tokens, i + 1, 1);
  }
}

/// `leg(90, 0,6s)`: a comma in a time, where the others have a blank behind them.
void decimal_comma(Line& line) {
  auto& tokens = line.tokens;
  for (std::size_t i = 1; i + 3 < tokens.size() && line.language() == Language::Structured; ++i) {
    const bool together = tokens[i].is(",") && tokens[i - 1].is_number() &&
                          tokens[i + 1].is_number() && !tokens[i].gap && !tokens[i + 1].gap &&
                          tokens[i + 2].is_word() && !tokens[i + 2].gap;
    if (!together || milliseconds_of(tokens[i + 2].text) == 0 ||
        std::none_of(tokens.begin(), tokens.begin() + static_cast<std::ptrdiff_t>(i),
                     [](const Token& token) { return token.is(","); }))
      continue;
    tokens[i - 1].text += "." + tokens[i + 1].text;
    take_out(tokens, i, 2);
    tokens[i].gap = false;
  }
}

/// `= Y + 1`: the name that a step begins with.
void missed_name(Line& line) {
  auto& tokens = line.tokens;
  if (tokens.size() < 3 || !tokens[0].is("=") || !line.is_variable(tokens[1]) ||
      !(tokens[2].is("+") || tokens[2].is("-")))
    return;
  auto name = tokens[1];
  name.gap = false;
  tokens[0].gap = true;
  tokens.insert(tokens.begin(), name);
  line.incomplete = true;
}

/// The signs that the statements of a line lack.
void missed_signs(Line& line) {
  const auto& tokens = line.tokens;
  for (std::size_t at = 0; at < tokens.size(); ++at)
    if (at == 0 || tokens[at - 1].is("then") || tokens[at - 1].is("else"))
      missed_sign(line, at);
}

/// `PP = W`: a variable whose key was hit twice.
void single_letters(Line& line) {
  auto& tokens = line.tokens;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto& text = tokens[i].text;
    if (tokens[i].is_word() && (tokens[i].gap || i == 0) && text.size() == 2 &&
        text[0] == text[1] && to_lower(text[0]) != text[0])
      tokens[i].text.resize(1);
  }
}

/// `goto line180`
void part_line(Line& line) {
  constexpr std::string_view prefix = "line";
  auto& tokens = line.tokens;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    const std::string_view word = tokens[i].text;
    if (tokens[i].is_word() && word.size() > prefix.size() &&
        equal_words(word.substr(0, prefix.size()), prefix) &&
        word.find_first_not_of("0123456789", prefix.size()) == std::string_view::npos)
      tokens[i] = Token{Token::Kind::Number, std::string(word.substr(prefix.size())), true};
  }
}

namespace {

constexpr auto glued = std::to_array<std::string_view>(
    {"goto", "gosub", "print", "return", "input", "then", "else", "next", "read", "step", "data",
     "for", "let", "rnd", "and", "if", "or", "to"});

/// `THENLETT` in its parts: keywords, and at the end a letter, a number or a known word. Empty
/// where it has none.
std::vector<std::string> parts_of_glued(std::string_view word,
                                        const std::vector<std::string_view>& words) {
  for (const auto keyword : glued) {
    if (word.size() <= keyword.size() || !equal_words(word.substr(0, keyword.size()), keyword))
      continue;
    const auto rest = word.substr(keyword.size());
    const bool ends = rest.size() == 1 || has_word(words, rest) ||
                      rest.find_first_not_of("0123456789") == std::string_view::npos;
    auto more = ends ? std::vector<std::string>{std::string(rest)} : parts_of_glued(rest, words);
    if (more.empty())
      continue;
    more.insert(more.begin(), std::string(keyword));
    return more;
  }
  return {};
}

} // namespace

/// `GOTO150` becomes `goto 150`, and `THENLETT` `then let T`.
void part_glued(Line& line) {
  auto& tokens = line.tokens;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].is_word() || tokens[i].text.size() < 3 || line.knows(tokens[i].text) ||
        (!is_digit(tokens[i].text.back()) && to_lower(tokens[i].text[0]) == tokens[i].text[0]))
      continue;
    const auto parts = parts_of_glued(tokens[i].text, line.dialect->words);
    auto token = tokens[i];
    for (std::size_t n = 0; n < parts.size(); ++n) {
      token.kind = is_digit(parts[n][0]) ? Token::Kind::Number : Token::Kind::Word;
      token.text = parts[n];
      token.gap = token.gap || n > 0 || (i > 0 && tokens[i - 1].kind != Token::Kind::Sign);
      if (n == 0)
        tokens[i] = token;
      else
        tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(i + n), token);
    }
    i += parts.empty() ? 0 : parts.size() - 1;
    if (!parts.empty() && i + 1 < tokens.size())
      tokens[i + 1].gap = tokens[i + 1].gap || tokens[i + 1].is_word() || tokens[i + 1].is_number();
  }
}

/// `forn = 1 to 5`
void part_for(Line& line) {
  constexpr std::string_view begins = "for";
  auto& tokens = line.tokens;
  if (tokens.size() < 5 || !tokens[0].text.starts_with(begins) ||
      tokens[0].text.size() == begins.size() || !tokens[1].is("=") || !has_token(tokens, "to"))
    return;
  tokens[0].text.erase(0, begins.size());
  tokens[0].gap = true;
  tokens.insert(tokens.begin(), Token{Token::Kind::Word, std::string(begins)});
}

/// `nexti` in a program with `i`.
void part_next(Line& line) {
  constexpr std::string_view next = "next";
  auto& tokens = line.tokens;
  if (tokens.size() != 1 || !tokens[0].text.starts_with(next) ||
      tokens[0].text.size() == next.size())
    return;
  auto name = tokens[0];
  name.text.erase(0, next.size());
  if (name.text.size() > 1 && !line.has_name(name.text))
    return;
  name.gap = true;
  tokens[0].text = next;
  tokens.push_back(name);
}

} // namespace orb::repair
