#include "repair/line_repair.h"

#include "base/text/text.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Quotes and brackets of a line that is to be mended: where one lacks, is too many, or quotes what
// is no text.

namespace orb::repair {
namespace {

/// A statement with a quote more or less than it has, and how unlikely the place is.
struct Requoted {
  std::string text;
  int cost;
};

constexpr int name_in_text = 2;
constexpr int odd_place = 3;

/// `text` with one quote more, wherever one may stand.
void put_in_quote(const std::string& text, std::vector<Requoted>& all) {
  bool closes = false; // an odd number of quotes stands before
  for (std::size_t at = 0; at <= text.size(); ++at) {
    const bool end = at == text.size();
    const bool sign = !end && std::string_view(",;+").find(text[at]) != std::string_view::npos;
    const bool blank = !end && is_blank(text[at]);
    const bool word = !end && at > 0 && is_letter(text[at]) && !is_letter(text[at - 1]);
    const bool after_sign =
        blank && at > 0 && std::string_view("=:").find(text[at - 1]) != std::string_view::npos;
    if (closes ? end || sign || blank : word || sign) {
      all.push_back({text, closes && blank   ? (after_sign ? 1 : odd_place)
                           : !closes && sign ? 1
                                             : 0});
      all.back().text.insert(after_sign ? at + 1 : at, after_sign ? "\" " : "\"");
    }
    closes = closes != (!end && text[at] == '"');
  }
}

/// `text` with a quote for a 2, which is on the same key.
void quote_for_two(const std::string& text, std::vector<Requoted>& all) {
  for (std::size_t at = 1; at < text.size(); ++at) {
    const char before = text[at - 1];
    const bool opens = is_blank(before) && at + 1 < text.size() && is_letter(text[at + 1]);
    const bool closes = at + 1 == text.size() && !is_blank(before) && !is_digit(before);
    if (text[at] != '2' || !(opens || closes))
      continue;
    all.push_back({text, -1});
    all.back().text[at] = '"';
  }
}

} // namespace

/// `"touches no wall'`: a text that another quote closes.
void LineRepair::close_text() {
  if (parts_.tokens.empty() || !parts_.tokens.back().is_text() || parts_.tokens.back().closed)
    return;
  auto& text = parts_.tokens.back();
  const auto end = text.text.find_last_not_of(":,;");
  if (end == std::string::npos || end == 0 || text.text[end] != '\'')
    return;
  text.text.resize(end);
  text.closed = true;
}

/// `warned = "False"`: what is true is 1.
void LineRepair::truths() {
  auto& tokens = parts_.tokens;
  if (is_program() && tokens.size() == 2 && holds("while until if", tokens[0].text) &&
      tokens[1].is_text() && holds("true false", tokens[1].text))
    tokens[1].kind = Token::Kind::Word; // `While "True"`
  if (!is_program() || tokens.size() != 3 || !tokens[1].is("=") || !tokens[2].is_text() ||
      !holds("true false", tokens[2].text))
    return;
  tokens[2].kind = Token::Kind::Number;
  tokens[2].text = equal_words(tokens[2].text, "true") ? "1" : "0";
}

/// `DATA "222","121"` and `RGB("0,255,0")`: neither takes a text.
void LineRepair::numbers_in_quotes() {
  auto& tokens = parts_.tokens;
  if (tokens.empty() || !(tokens[0].is("data") || tokens[0].is("RGB")))
    return;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    const std::string_view said = tokens[i].text;
    if (!tokens[i].is_text() || said.empty() || !is_digit(said[0]) ||
        said.find_first_not_of("0123456789, ") != std::string_view::npos)
      continue;
    const auto values = tokens_of(said, judge_.language);
    const auto at = tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i));
    tokens.insert(at, values.begin(), values.end());
  }
}

/// `state = "open"` where the program has `open`.
void LineRepair::names_in_quotes() {
  auto& tokens = parts_.tokens;
  if (judge_.language != Language::Structured || has_token(tokens, "print"))
    return;
  for (std::size_t i = 1; i < tokens.size(); ++i)
    if (tokens[i].is_text() && tokens[i - 1].is_relation() && has_word(names_, tokens[i].text))
      tokens[i].kind = Token::Kind::Word;
}

/// Whether a text ends in a comma and a name: `"yes! in, tries "`.
bool LineRepair::ends_in_name(const Token& text) const {
  const auto comma = text.text.rfind(',');
  if (!text.is_text() || comma == std::string::npos)
    return false;
  const auto name = trim(std::string_view(text.text).substr(comma + 1));
  return has_word(names_, name) || (judge_.language == Language::Basic && name.size() == 1);
}

/// How unlikely a statement is by its texts: names of the program in them say that they end
/// elsewhere. Nothing where an unknown word stands outside of them, or one is empty.
std::optional<int> LineRepair::cost_of_texts(std::string_view statement) const {
  const auto is_value = [&](const Token& token) {
    const bool letter = token.text.size() == 1;
    return token.is_word() &&
           (letter ? judge_.language != Language::Basic || to_lower(token.text[0]) != token.text[0]
                   : has_word(names_, token.text) || has_word(judge_.words, token.text));
  };
  int cost = 0;
  const auto tokens = tokens_of(statement, judge_.language);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is_word() && !is_value(tokens[i]))
      return std::nullopt;
    if (i > 1 && tokens[i].is_word() && tokens[i - 1].is(",") &&
        tokens[i - 2].text == tokens[i].text)
      cost += odd_place; // `"lost", longest, longest`
    if (!tokens[i].is_text())
      continue;
    const std::string_view said = tokens[i].text;
    if (said.empty() || (i + 1 < tokens.size() && tokens[i + 1].is_text() && !tokens[i + 1].gap))
      return std::nullopt;
    for (const auto& token : tokens_of(said, judge_.language))
      cost += is_value(token) ? name_in_text : 0;
    const bool touches =
        (i > 0 && tokens[i - 1].is_word() && !tokens[i].gap && !tokens[i - 1].is("print")) ||
        (i + 1 < tokens.size() && tokens[i + 1].is_word() && !tokens[i + 1].gap);
    cost += touches ? odd_place + 1 : 0; // `lost", "lost`
    const bool begins_between = std::string_view(",;").find(said[0]) != std::string_view::npos &&
                                said.find_first_not_of(",; ") != std::string_view::npos;
    cost += begins_between ? odd_place : 0;
  }
  return cost;
}

/// A `print` with an odd number of quotes, with one more or less: the best places, which leave the
/// fewest names of the program in texts. `print "toss, C ": " T` is `print "toss", C ": " T`.
std::vector<std::string> LineRepair::with_one_quote() const {
  const std::string text(trim(line_.substr(std::min(parts_.head.size(), line_.size()))));
  constexpr std::size_t longest = 160;
  if (!is_program() || std::count(text.begin(), text.end(), '"') % 2 == 0 ||
      text.size() > longest || !has_token(parts_.tokens, "print") || text.ends_with('\''))
    return {};
  std::vector<Requoted> all;
  put_in_quote(text, all);
  quote_for_two(text, all);
  if (text.ends_with('"')) // one too many
    all.push_back({text.substr(0, text.size() - 1), 0});
  std::vector<std::string> best;
  std::optional<int> least;
  for (const auto& one : all) {
    const auto cost = cost_of_texts(one.text);
    if (!cost || (least && *cost + one.cost > *least) || !judge_.parses(parts_.head + one.text))
      continue;
    if (!least || *cost + one.cost < *least)
      best.clear();
    least = *cost + one.cost;
    best.push_back(one.text);
  }
  return best;
}

/// A bracket that is not closed: `if not (a = 1 then`, `goroll (H + 90 % 360, 80, 1`. Empty where
/// it is.
std::string LineRepair::with_bracket() const {
  auto tokens = parts_.tokens;
  for (std::size_t i = 3; i + 1 < tokens.size(); ++i) {
    const bool turn = tokens[i].is("%") && tokens[i + 1].is("360");
    if (!turn ||
        std::count_if(tokens.begin(), tokens.end(),
                      [](const Token& token) { return token.is("("); }) != 1 ||
        has_token(tokens, ")"))
      continue;
    tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(i), Token{Token::Kind::Sign, ")"});
    return join(tokens);
  }
  const auto then = std::find_if(tokens.begin(), tokens.end(),
                                 [](const Token& token) { return token.is("then"); });
  const bool first = tokens.size() > 1 && tokens[1].is("(");
  int open = 0;
  for (auto at = tokens.begin(); at != then; ++at)
    open += at->is("(") ? 1 : at->is(")") ? -1 : 0;
  if (open != 1 || (then == tokens.end() && first))
    return {};
  tokens.insert(then, Token{Token::Kind::Sign, ")"});
  return join(tokens);
}

} // namespace orb::repair
