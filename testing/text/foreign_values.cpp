#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/units.h"
#include "testing/text/foreign.h"
#include "testing/text/vocabulary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

// Texts, colours, ranges and counts as other languages write them.

namespace orb::testing {
namespace {

using repair::append;
using repair::close_of;
using repair::Language;
using repair::Token;
using repair::Tokens;
using repair::word;

/// `print [yes! in 5 tries]` and `test [is patient]`: the texts of Logo.
Tokens with_quotes_for_brackets(const Tokens& line) {
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool opens = i > 0 && line[i].is("[") && line[i].gap &&
                       (says_print(line[i - 1]) || line[i - 1].is("test"));
    const auto close = opens ? close_of(line, i) : line.size();
    if (close >= line.size() || close == i + 1) {
      all.push_back(line[i]);
      continue;
    }
    auto words = repair::slice(line, i + 1, close);
    words[0].gap = false;
    all.push_back(Token{Token::Kind::Text, repair::join(words), true});
    i = close;
  }
  return all;
}

/// `{ r: 255, g: 165, b: 0 }` as `#FFA500`.
Tokens with_plain_colours(const Tokens& line) {
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto close = line[i].is("{") ? close_of(line, i) : line.size();
    std::string hex;
    for (auto at = i + 1; close < line.size() && at + 2 <= close; ++at)
      if (line[at].is(":") && line[at + 1].is_number())
        if (const auto value = parse_number<int>(line[at + 1].text); value && *value <= UINT8_MAX)
          hex += fmt::format("{:02X}", *value);
    constexpr std::size_t digits = 6;
    if (hex.size() != digits) {
      all.push_back(line[i]);
      continue;
    }
    all.push_back(Token{Token::Kind::Colour, "#" + hex, true});
    i = close;
  }
  return all;
}

/// `"5" + " corners"` is one text, and Python's `r"^a$"` a pattern.
Tokens with_whole_texts(const Tokens& line) {
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool last = i + 2 == line.size() && line[i].is(";"); // `"F(12) = "; 144`
    const bool goes_on = i + 1 < line.size() && (line[i].is("+") || last) && !all.empty() &&
                         all.back().is_text() && (line[i + 1].is_text() || line[i + 1].is_number());
    if (goes_on) {
      all.back().text += line[++i].text;
      continue;
    }
    const bool pattern = i + 1 < line.size() && line[i].is("r") && line[i + 1].is_text() &&
                         !line[i + 1].gap && i > 0;
    if (pattern) {
      append(all, repair::tokens_of("/" + line[++i].text + "/", Language::Test));
      continue;
    }
    all.push_back(line[i]);
  }
  return all;
}

/// `print("done", true)` is `print "done"`, `print("done") = 1` happens once, and
/// `(resting, "at end")` is `resting at end`.
Tokens with_plain_calls(const Tokens& line) {
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool prints = i > 0 && line[i].is("(") && says_print(line[i - 1]);
    const auto close = prints ? close_of(line, i) : line.size();
    if (close < line.size() && line[i + 1].is_text() && line[i + 2].is(",")) {
      all.push_back(line[i + 1]);
      all.back().gap = true;
      i = close;
      continue;
    }
    const bool waits = i == 1 && line[i].is("(") && line[0].is("expect") && line.size() > 5 &&
                       line[2].is_word() && line[3].is(",") && line[4].is_text();
    if (waits && close_of(line, i) == 5) {
      all.push_back(line[2]);
      all.back().gap = true;
      append(all, repair::tokens_of(line[4].text, Language::Test));
      i = 5;
      continue;
    }
    all.push_back(line[i]);
  }
  if (all.size() > 2 && all.back().is_number() && all[all.size() - 2].is("/")) { // `/^a$/ 6`
    all.back().gap = true;
    all.push_back(word("times"));
  }
  if (all.size() > 5 && all[1].is("(") && (all[0].is("expect") || all[0].is("never")) &&
      all[3].is_relation() && close_of(all, 1) == 5) { // `expect (inside == garage) at end`
    all[2].gap = all[4].gap = true;
    all.erase(all.begin() + 5);
    all.erase(all.begin() + 3);
    all.erase(all.begin() + 1);
  }
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const bool after_text =
        all[i - 1].is_text() || (all[i - 1].is(")") && i > 2 && all[i - 2].is_text());
    if (!after_text || !(all[i].is("=") || all[i].is("==") || all[i].is("===")) ||
        !all[i + 1].is_number())
      continue;
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
    all[i].gap = true;
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(i) + 1, word("times"));
  }
  return all;
}

/// `3m <= distance <= 4m` as `distance 3m..4m`.
Tokens between_bounds(const Tokens& line) {
  const auto middle = std::find_if(line.begin(), line.end(), [](const Token& token) {
    return token.is("distance") || token.is("speed");
  });
  const auto at = static_cast<std::size_t>(middle - line.begin());
  if (at < 2 || at + 2 >= line.size() || !line[at - 1].is_relation() ||
      !line[at + 1].is_relation() || !line[at + 2].is_number())
    return line;
  std::size_t first = at - 1; // where the lower bound begins
  while (first > 0 && !line[first].is_number())
    --first;
  if (!line[first].is_number())
    return line;
  auto all = repair::slice(line, 0, first);
  all.push_back(*middle);
  all.back().gap = true;
  auto low = repair::slice(line, first, at - 1);
  low[0].gap = true;
  repair::append(all, low);
  all.push_back(Token{Token::Kind::Sign, ".."});
  auto high = repair::slice(line, at + 2);
  high[0].gap = false;
  repair::append(all, high);
  return all;
}

/// `distance >= 13m and distance <= 15m` as `distance 13m..15m`.
Tokens with_bounds(const Tokens& line) {
  struct Bound {
    bool least = false;
    std::string name;
    Tokens value;
    std::size_t end = 0;
  };
  const auto bound = [&](std::size_t at) -> std::optional<Bound> {
    Bound one;
    if (at < line.size() && line[at].is_word())
      one.name = line[at++].text;
    if (at + 1 >= line.size() || !line[at + 1].is_number())
      return std::nullopt;
    const auto& sign = line[at].text;
    if (sign != ">" && sign != ">=" && sign != "<" && sign != "<=")
      return std::nullopt;
    one.least = sign[0] == '>';
    one.end =
        at + 2 + (at + 2 < line.size() && line[at + 2].is_word() && !line[at + 2].gap ? 1 : 0);
    one.value = repair::slice(line, at + 1, one.end);
    return one;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto first = bound(i);
    if (!first || first->name.empty() || first->end >= line.size() ||
        !(line[first->end].is("and") || line[first->end].is("&&")))
      continue;
    const auto second = bound(first->end + 1);
    if (!second || second->least == first->least ||
        (!second->name.empty() && second->name != first->name))
      continue;
    auto all = repair::slice(line, 0, i + 1);
    append(all, first->least ? first->value : second->value);
    all[i + 1].gap = true;
    all.push_back(Token{Token::Kind::Sign, ".."});
    auto most = first->least ? second->value : first->value;
    most[0].gap = false;
    append(all, most);
    append(all, repair::slice(line, second->end));
    return all;
  }
  return line;
}

/// `y=-30`: the sign belongs to the number.
Tokens with_signs_apart(const Tokens& line) {
  Tokens all;
  for (const auto& token : line) {
    all.push_back(token);
    if (!token.is("=-"))
      continue;
    all.back().text = "=";
    all.push_back(Token{Token::Kind::Sign, "-"});
  }
  return all;
}

/// `stop all` is the end, and what ends in `at` is so at the end.
Tokens with_end(Tokens line) {
  for (std::size_t i = 1; i + 2 < line.size(); ++i)
    if (holds("number amount", line[i].text) && line[i + 1].is("of"))
      line.erase(line.begin() + static_cast<std::ptrdiff_t>(i),
                 line.begin() + static_cast<std::ptrdiff_t>(i) + 2);
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    if (line[i].is("stop") && holds("all program script everything", line[i + 1].text)) {
      line[i] = word("end");
      line.erase(line.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  if (line.size() > 2 && line.back().is(":"))
    line.pop_back();
  if (line.size() > 3 && line.back().is("end") && line[line.size() - 2].is(","))
    line[line.size() - 2] = word("at"); // `resting, end`
  if (line.size() > 2 && line.back().is("at"))
    line.push_back(word("end"));
  return line;
}

/// `to "drives home"` and `to test "drives home"`, as Logo begins a procedure.
Tokens with_test(Tokens line) {
  if (line.size() > 1 && line[0].is("to") && line[1].is_text())
    line[0].text = "test";
  else if (line.size() > 2 && (line[0].is("to") || line[0].is("when")) && line[1].is("test"))
    line.erase(line.begin());
  if (line.size() > 2 && line[0].is("test") && line[1].is_text() && line[2].is("starts"))
    line.resize(2); // `when test "a" starts`
  return line;
}

/// `getLocation().x > 40` is `beyond x > 40`.
Tokens with_beyond(Tokens line) {
  if (line.size() > 4 && (line[0].is("never") || line[0].is("expect")) && line[1].is("(") &&
      (line[2].is("x") || line[2].is("y")) && line[3].is_relation() &&
      close_of(line, 1) < line.size()) { // `never (y < -90)`
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(close_of(line, 1)));
    line[1] = word("beyond");
    return line;
  }
  for (std::size_t i = 2; i + 1 < line.size(); ++i)
    if ((line[i].is("x") || line[i].is("y")) && line[i - 1].is(".") && line[i + 1].is_relation()) {
      auto begin = i - 1;
      if (begin > 2 && line[begin - 1].is(")") && line[begin - 2].is("("))
        begin -= 2;
      if (begin == 0 || !line[begin - 1].is_word())
        return line;
      line[begin - 1] = word("beyond");
      line[i].gap = true;
      line.erase(line.begin() + static_cast<std::ptrdiff_t>(begin),
                 line.begin() + static_cast<std::ptrdiff_t>(i));
      return line;
    }
  return line;
}

/// `inside goal : color green : resting at end`: what is so at once.
Tokens with_and(Tokens line) {
  if (line.empty() || !(line[0].is("expect") || line[0].is("never")))
    return line;
  for (std::size_t i = 2; i + 1 < line.size(); ++i)
    if (line[i].is(":") && line[i].gap && line[i + 1].gap && line[i + 1].is_word() &&
        !line[i + 1].is("at"))
      line[i] = word("and");
  return line;
}

/// A name without its first quote, or without both: `test drives round" seeds 1..5`.
Tokens with_name(const Tokens& line) {
  const auto text =
      std::find_if(line.begin(), line.end(), [](const Token& token) { return token.is_text(); });
  if (line.size() > 2 && line[0].is("test") && text > line.begin() + 1 && text != line.end() &&
      text->closed) { // `test if it "finds 25"`, `test: "a", seeds = 1 to 50`
    auto all = Tokens{line[0]};
    append(all, Tokens(text, line.end()));
    all[1].gap = true;
    return all;
  }
  if (line.size() < 3 || !line[0].is("test") || !line[1].is_word() || line[1].is("seeds"))
    return line;
  const bool clause = holds("that if whether dass ob que si che", line[1].text);
  const std::size_t begin = !clause ? 1 : line[2].is("it") ? 3 : 2; // `test that it stops`
  std::size_t end = begin;
  while (end < line.size() && !line[end].is_text() && !line[end].is("seeds"))
    ++end;
  const bool closes = end + 1 == line.size() && line[end].is_text() && !line[end].closed;
  if (!closes && end < line.size() && line[end].is_text())
    return line;
  auto said = repair::slice(line, begin, end);
  if (said.empty())
    return line;
  said[0].gap = false;
  Tokens all{line[0], Token{Token::Kind::Text, repair::join(said), true}};
  append(all,
         closes ? repair::tokens_of(line[end].text, Language::Test) : repair::slice(line, end));
  if (all.size() > 2)
    all[2].gap = true;
  return all;
}

/// `6in` is `15cm`; what is in metres stays.
Tokens with_metric_lengths(Tokens line) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!line[i - 1].is_number() || !line[i].is_word() || (line[i].gap && line[i].is("in")))
      continue;
    const auto* const unit = repair::unit_called(line[i].text, Measure::Length);
    if (unit != nullptr && find_unit(unit->word, length_units) == nullptr) {
      const auto value =
          parse_number<double>(line[i - 1].text, std::chars_format::fixed).value_or(0) *
          unit->in(unit::cm);
      line[i - 1].text = std::to_string(std::lround(value));
      line[i] = Token{Token::Kind::Word, "cm", false};
    }
  }
  return line;
}

} // namespace

bool says_print(const Token& token) {
  return token.is_word() && (token.is("print") || repair::is_called("print", token.text));
}

Tokens with_plain_values(const Tokens& line) {
  const auto plain = with_test(with_beyond(with_and(with_signs_apart(line))));
  const auto all = with_name(with_whole_texts(with_quotes_for_brackets(plain)));
  return with_metric_lengths(
      with_end(with_bounds(between_bounds(with_plain_calls(with_plain_colours(all))))));
}

} // namespace orb::testing
