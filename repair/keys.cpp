#include "repair/normalise.h"

#include "base/text/text.h"

#include <algorithm>
#include <string>
#include <string_view>

// Typing errors: an adjacent key, a missing shift, a missing character.

namespace orb::repair {
/// `H.120` and `goroll T * 10.60,1`: a point for the adjacent comma.
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

/// Adds the missing sign of a statement that begins at `at`: `C 0 C + 1`, `W + W / 2`, `N = N 1`.
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

/// Moves a misplaced space: `nex tB`, and `wait_for shake` in a program with `wait_for_shake`.
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

/// Adds the missing signs of all statements of a line.
void missed_signs(Line& line) {
  const auto& tokens = line.tokens;
  for (std::size_t at = 0; at < tokens.size(); ++at)
    if (at == 0 || tokens[at - 1].is("then") || tokens[at - 1].is("else"))
      missed_sign(line, at);
}

/// `PP = W`: a variable typed twice.
void single_letters(Line& line) {
  auto& tokens = line.tokens;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto& text = tokens[i].text;
    const bool numbers = !line.head.empty() && is_digit(line.head.back()) &&
                         looks_like_digits(text); // `1OO delay 5`
    const bool begins = tokens[i].gap || (i == 0 && !numbers);
    if (tokens[i].is_word() && begins && text.size() == 2 && text[0] == text[1] &&
        to_lower(text[0]) != text[0])
      tokens[i].text.resize(1);
  }
}

} // namespace orb::repair
