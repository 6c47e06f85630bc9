#include "repair/quotes.h"

#include "base/text/text.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace orb::repair {
namespace {

/// A statement with one quote added or removed, and a cost for its position.
struct Requoted {
  std::string text;
  int cost;
};

constexpr int name_in_text = 2;
constexpr int odd_place = 3;

/// Adds variants of `text` with one more quote, at every possible position.
void put_in_quote(const std::string& text, std::vector<Requoted>& all) {
  bool closes = false; // inside a text: an odd number of quotes precedes
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

/// Adds variants of `text` with a quote for a 2, which is on the same key.
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

/// The cost of a statement by its texts: names of the program inside them suggest that they end
/// elsewhere. Nothing if an unknown word is outside of them, or one is empty.
std::optional<int> cost_of_texts(const Line& line, std::string_view statement) {
  const auto is_value = [&](const Token& token) {
    const bool letter = token.text.size() == 1;
    return token.is_word() &&
           (letter ? line.language() != Language::Basic || to_lower(token.text[0]) != token.text[0]
                   : line.has_name(token.text) || line.knows(token.text));
  };
  int cost = 0;
  const auto tokens = tokens_of(statement, line.language());
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
    for (const auto& token : tokens_of(said, line.language()))
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

} // namespace

std::vector<std::string> with_one_quote(const Line& line) {
  const std::string text(trim(line.written.substr(line.head_size)));
  constexpr std::size_t longest = 160;
  if (!line.is_program() || std::count(text.begin(), text.end(), '"') % 2 == 0 ||
      text.size() > longest || !has_token(line.tokens, "print") || text.ends_with('\''))
    return {};
  std::vector<Requoted> all;
  put_in_quote(text, all);
  quote_for_two(text, all);
  if (text.ends_with('"')) // one too many
    all.push_back({text.substr(0, text.size() - 1), 0});
  std::vector<std::string> best;
  std::optional<int> least;
  for (const auto& one : all) {
    const auto cost = cost_of_texts(line, one.text);
    if (!cost || (least && *cost + one.cost > *least) ||
        !line.dialect->parses(line.head + one.text))
      continue;
    if (!least || *cost + one.cost < *least)
      best.clear();
    least = *cost + one.cost;
    best.push_back(one.text);
  }
  return best;
}

std::string with_bracket(const Line& line) {
  auto tokens = line.tokens;
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
