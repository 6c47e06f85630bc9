#include "repair/line_repair.h"

#include "base/text/text.h"
#include "repair/units.h"

#include <algorithm>
#include <string>
#include <string_view>

// Slips of the hand that make another sign: the key beside, the same key without its shift, one
// that was not hit at all. What they leave is read before the line is.

namespace orb::repair {

/// Whether a token is a variable of the program.
bool LineRepair::is_variable(const Token& token) const {
  return token.is_word() && !has_word(judge_.words, token.text) &&
         (token.text.size() == 1 || has_word(names_, token.text));
}

/// How often a sign stands in the line.
std::ptrdiff_t LineRepair::count_of(std::string_view sign) const {
  return std::count_if(parts_.tokens.begin(), parts_.tokens.end(),
                       [&](const Token& token) { return token.is(sign); });
}

/// Digits typed for the signs on their keys: `next_of9n)`, `delay L 8 75`, `M 5 10`; and `m` for
/// the comma beside it.
void LineRepair::read_shifted() {
  auto& tokens = parts_.tokens;
  if (!is_program() || tokens.size() < 3)
    return;
  for (std::size_t i = 0; i < tokens.size() && count_of(")") > count_of("("); ++i) {
    const auto nine = tokens[i].is_word() ? tokens[i].text.find('9') : std::string::npos;
    if (nine == std::string::npos || nine == 0)
      continue;
    auto rest = tokens_of(std::string_view(tokens[i].text).substr(nine + 1), judge_.language);
    tokens[i].text.resize(nine);
    rest.insert(rest.begin(), Token{Token::Kind::Sign, "("});
    tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest.begin(), rest.end());
  }
  const auto is_value = [&](const Token& token) { return token.is(")") || is_variable(token); };
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
void LineRepair::close_by_key() {
  auto& tokens = parts_.tokens;
  auto& last = tokens.back();
  if (count_of("(") <= count_of(")") || last.text.size() < 2 || !last.text.ends_with('0') ||
      !last.is_word())
    return;
  const auto name = last.text.substr(0, last.text.size() - 1);
  if (has_word(names_, last.text) ||
      !(has_word(names_, name) || holds("sub function", tokens[0].text)))
    return;
  last.text = name;
  tokens.push_back(Token{Token::Kind::Sign, ")"});
  guessed_ = true;
}

/// `H.120` and `goroll T * 10.60,1`: a point for the comma beside it.
void LineRepair::comma_for_point() {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 1; i < tokens.size() && holds("goroll RGB", tokens[0].text); ++i) {
    const auto point = tokens[i].text.find('.');
    const bool inside =
        point != std::string::npos && point > 0 && point + 1 < tokens[i].text.size();
    if (!inside || count_of(",") != 1 || !tokens[i].is_number())
      continue;
    auto second = tokens[i];
    second.text.erase(0, point + 1);
    tokens[i].text.resize(point);
    const auto next = tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    tokens.insert(next, {Token{Token::Kind::Sign, ","}, second});
    guessed_ = true;
  }
  for (std::size_t i = 2; i < tokens.size(); ++i) {
    auto& token = tokens[i];
    const bool together = !token.gap && is_variable(tokens[i - 1]);
    if (together && token.is(".") && i + 1 < tokens.size() && tokens[i + 1].is_number()) {
      token.text = ",";
    } else if (together && token.is_number() && token.text.starts_with('.') &&
               token.text.size() > 1) {
      token.text.erase(0, 1);
      tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(i), Token{Token::Kind::Sign, ","});
    }
  }
}

/// The sign that a statement lacks which begins at `at`: `C 0 C + 1`, `W + W / 2`, `N = N 1`.
void LineRepair::missed_sign(std::size_t at) {
  auto& tokens = parts_.tokens;
  if (at + 2 >= tokens.size() || !is_variable(tokens[at]))
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
    guessed_ = true;
  } else if (sign.is("=") && end - rest > 2 && rest->text == tokens[at].text &&
             (rest + 1)->is("=")) {
    (rest + 1)->text = "+"; // `S = S = A * B`
    guessed_ = true;
  } else if (sign.is("=") && end - rest == 2 && rest->text == tokens[at].text &&
             (rest + 1)->is_number() && (rest + 1)->gap) {
    tokens.insert(rest + 1, Token{Token::Kind::Sign, "+", true});
    guessed_ = true;
  }
}

/// `if c then H = 270 H = 90`: two statements, of which the second is for the other case.
void LineRepair::missed_else() {
  auto& tokens = parts_.tokens;
  if (!tokens[0].is("if") || count_of("else") > 0)
    return;
  const auto then = std::find_if(tokens.begin(), tokens.end(),
                                 [](const Token& token) { return token.is("then"); });
  for (auto at = then; at != tokens.end() && tokens.end() - at > 2; ++at) {
    const bool begins = at - then > 3 && at->gap && is_variable(*at) && (at + 1)->is("=");
    if (!begins || !((at - 1)->is_number() || (at - 1)->is(")") || is_variable(*(at - 1))))
      continue;
    tokens.insert(at, word("else"));
    guessed_ = true;
    return;
  }
}

/// `nex tB`, and `wait_for shake` in a program with `wait_for_shake`: a blank in the wrong place.
void LineRepair::join_words() {
  auto& tokens = parts_.tokens;
  if (judge_.language == Language::Basic && tokens[0].is_word() && tokens[1].is_word() &&
      tokens[1].text.size() == 2 && has_word(judge_.words, tokens[0].text + tokens[1].text[0])) {
    tokens[0].text += tokens[1].text[0];
    tokens[1].text.erase(0, 1);
  }
  for (std::size_t i = 0; i + 1 < tokens.size() && judge_.language == Language::Structured; ++i) {
    const auto name = tokens[i].text + "_" + tokens[i + 1].text;
    if (!tokens[i].is_word() || !tokens[i + 1].is_word() || !has_word(names_, name) ||
        has_word(judge_.words, tokens[i].text))
      continue;
    tokens[i].text = name;
    take_out(tokens, i + 1, 1);
  }
}

/// `leg(90, 0,6s)`: a comma in a time, where the others have a blank behind them.
void LineRepair::decimal_comma() {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 1; i + 3 < tokens.size() && judge_.language == Language::Structured; ++i) {
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

/// Signs and words that the hand missed.
void LineRepair::read_missed() {
  auto& tokens = parts_.tokens;
  if (!is_program() || tokens.size() < 2)
    return;
  join_words();
  if (tokens.size() < 3)
    return;
  if (tokens[0].is("=") && is_variable(tokens[1]) && (tokens[2].is("+") || tokens[2].is("-"))) {
    auto name = tokens[1]; // `= Y + 1`
    name.gap = false;
    tokens[0].gap = true;
    tokens.insert(tokens.begin(), name);
    guessed_ = true;
  }
  close_by_key();
  comma_for_point();
  decimal_comma();
  for (std::size_t at = 0; at < tokens.size(); ++at)
    if (at == 0 || tokens[at - 1].is("then") || tokens[at - 1].is("else"))
      missed_sign(at);
  missed_else();
}

/// `sub drive(time as integer)` and `sub bar(length in steps)`: parameters are numbers.
void LineRepair::drop_types() {
  auto& tokens = parts_.tokens;
  if (judge_.language != Language::Structured || tokens.size() < 6 ||
      !holds("sub function def to", tokens[0].text) || !tokens[2].is("("))
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
void LineRepair::read_thousands() {
  constexpr std::string_view thousand = ".000";
  auto& tokens = parts_.tokens;
  if (!is_program() || tokens.empty() || holds("delay wait sleep pause", tokens[0].text))
    return;
  for (auto& token : tokens)
    if (token.is_number() && token.text.size() > thousand.size() && token.text.ends_with(thousand))
      token.text.erase(token.text.size() - thousand.size(), 1);
}

} // namespace orb::repair
