#include "repair/line_repair.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/colours.h"
#include "repair/inflections.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <cmath>

// How a line that is to be mended is read: spellings, labels, arrays and quotes, before anything is
// tried.

namespace orb::repair {
/// Words in their documented spelling where the robot looks at case, numbers without `0x`.
void LineRepair::canonical() {
  auto& tokens = parts_.tokens; // `print "A is " A"`: the last quote is too many
  if (tokens.size() > 2 && tokens.back().is_text() && !tokens.back().closed &&
      tokens.back().text.empty() &&
      std::any_of(tokens.begin(), tokens.end() - 1,
                  [](const Token& token) { return token.is_text(); }) &&
      !ends_in_name(tokens[1]))
    tokens.pop_back();
  if (tokens.size() == 1 && tokens[0].is("]"))
    tokens[0].text = "}";
  close_text();
  truths();
  read_logo();
  drop_small_words();
  read_zeros();
  single_letters();
  drop_brackets();
  drop_colons();
  read_branches();
  read_shifted();
  read_missed();
  drop_types();
  read_thousands();
  read_hexadecimal();
  plain_signs();
  part_line();
  part_glued();
  part_for();
  part_next();
  same_letters();
  drop_prefixes();
  without_accents();
  numbers_in_quotes();
  names_in_quotes();
  other_forms();
  count_percents();
  drop_sigils();
  for (std::size_t i = 3; i < tokens.size(); ++i) { // `if open = "true"`
    const bool said = tokens[i].is_text() || judge_.language == Language::Test;
    if (!said || !tokens[i - 1].is_relation())
      continue;
    const bool bare = judge_.language == Language::Structured || judge_.language == Language::Test;
    if (equal_words(tokens[i].text, "true") && bare && tokens[i - 1].is("=")) {
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i) - 1,
                   tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      i -= 2;
    } else if (equal_words(tokens[i].text, "true") || equal_words(tokens[i].text, "false")) {
      tokens[i].kind = Token::Kind::Word;
    }
  }
  for (auto& token : parts_.tokens) {
    if (token.is_word() && judge_.language != Language::Structured &&
        std::find(judge_.words.begin(), judge_.words.end(), token.text) == judge_.words.end()) {
      const auto same =
          std::find_if(judge_.words.begin(), judge_.words.end(), [&](std::string_view one) {
            return one.size() > 1 && equal_words(one, token.text);
          });
      if (same != judge_.words.end())
        token.text = *same;
    }
    if (token.is_number() && judge_.language == Language::Basic && token.text.size() > 2 &&
        to_lower(token.text[1]) == 'x')
      if (const auto value = parse_number<std::int32_t>(std::string_view(token.text).substr(2), 16))
        token.text = std::to_string(*value);
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

/// `forn = 1 to 5`
void LineRepair::part_for() {
  constexpr std::string_view begins = "for";
  auto& tokens = parts_.tokens;
  if (judge_.language != Language::Structured || tokens.size() < 5 ||
      !tokens[0].text.starts_with(begins) || tokens[0].text.size() == begins.size() ||
      !tokens[1].is("=") || !has_token(tokens, "to"))
    return;
  tokens[0].text.erase(0, begins.size());
  tokens[0].gap = true;
  tokens.insert(tokens.begin(), Token{Token::Kind::Word, std::string(begins)});
}

/// `nexti` in a program with `i`.
void LineRepair::part_next() {
  constexpr std::string_view next = "next";
  auto& tokens = parts_.tokens;
  if (tokens.size() != 1 || judge_.language != Language::Structured ||
      !tokens[0].text.starts_with(next) || tokens[0].text.size() == next.size())
    return;
  auto name = tokens[0];
  name.text.erase(0, next.size());
  if (name.text.size() > 1 && !has_word(names_, name.text))
    return;
  name.gap = true;
  tokens[0].text = next;
  tokens.push_back(name);
}

/// `goto line180`
void LineRepair::part_line() {
  constexpr std::string_view line = "line";
  auto& tokens = parts_.tokens;
  for (std::size_t i = 1; i < tokens.size() && judge_.language == Language::Basic; ++i) {
    const std::string_view word = tokens[i].text;
    if (tokens[i].is_word() && word.size() > line.size() &&
        equal_words(word.substr(0, line.size()), line) &&
        word.find_first_not_of("0123456789", line.size()) == std::string_view::npos)
      tokens[i] = Token{Token::Kind::Number, std::string(word.substr(line.size())), true};
  }
}

/// `GOTO150` becomes `goto 150`, and `THENLETT` `then let T`.
void LineRepair::part_glued() {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 0; i < tokens.size() && judge_.language == Language::Basic; ++i) {
    if (!tokens[i].is_word() || tokens[i].text.size() < 3 ||
        has_word(judge_.words, tokens[i].text) ||
        (!is_digit(tokens[i].text.back()) && to_lower(tokens[i].text[0]) == tokens[i].text[0]))
      continue;
    const auto parts = parts_of_glued(tokens[i].text, judge_.words);
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

/// Operators of C and its children, which every such line has.
void LineRepair::plain_signs() {
  if (judge_.language == Language::Macro)
    return;
  for (std::size_t i = 2; i + 1 < parts_.tokens.size(); ++i) { // `60 plus tilt`
    auto& token = parts_.tokens[i];
    if (is_program() && token.is("percent") && is_unknown(token) && !parts_.tokens[0].is("print") &&
        (is_variable(parts_.tokens[i - 1]) || parts_.tokens[i - 1].is(")")))
      token = Token{Token::Kind::Sign, "%", true}; // `n percent d`
    if (is_program() && (token.is("plus") || token.is("minus")) && !has_word(names_, token.text) &&
        !parts_.tokens[i - 1].is("=") && !parts_.tokens[0].is("print"))
      token = Token{Token::Kind::Sign, token.is("plus") ? "+" : "-", true};
  }
  for (auto& token : parts_.tokens)
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

/// `make "side :side + 5` and `setpc "blue`: the words of Logo have one quote, its values a colon,
/// its texts brackets.
void LineRepair::read_logo() {
  auto& tokens = parts_.tokens;
  const std::size_t print = tokens.size() > 2 && tokens[0].is("(") ? 1 : 0;
  for (std::size_t i = print + 1; i < tokens.size() && is_program() && tokens[print].is("print");
       ++i) {
    const auto close = tokens[i].is("[") && tokens[i].gap ? close_of(tokens, i) : tokens.size();
    if (close == tokens.size() || close < i + 2 || !tokens[i + 1].is_word())
      continue; // `print [longest hold] :longest`
    const Token text{Token::Kind::Text, join(slice(tokens, i + 1, close)), true};
    const auto at = tokens.begin() + static_cast<std::ptrdiff_t>(i);
    tokens.insert(tokens.erase(at, tokens.begin() + static_cast<std::ptrdiff_t>(close) + 1), text);
  }
  const auto size = tokens.size();
  if (size < 2 || !tokens[size - 1].is_text() || tokens[size - 1].closed ||
      !holds("make go setpc setpencolor setcolor setcolour", tokens[size - 2].text))
    return;
  auto rest = tokens_of(tokens[size - 1].text, judge_.language);
  if (!rest.empty())
    rest[0].gap = true;
  tokens.pop_back();
  append(tokens, rest);
}

/// `if :n > 3`: values of Logo.
void LineRepair::drop_colons() {
  auto& tokens = parts_.tokens;
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
void LineRepair::read_branches() {
  auto& tokens = parts_.tokens;
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
void LineRepair::read_hexadecimal() {
  auto& tokens = parts_.tokens;
  if (!is_program())
    return;
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

/// `let the course be 0`, `print "I take" and then N`, `read v cm`: words that no program has
/// there.
void LineRepair::drop_small_words() {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 1; i + 2 < tokens.size(); ++i) // `marker no. 13`
    if (holds("no nr nº num", tokens[i].text) && tokens[i + 1].is(".") && !tokens[i + 1].gap)
      take_out(tokens, i, 2);
  if (!is_program())
    return;
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
    if ((tokens[i].is("the") && !has_word(names_, "the")) ||
        (tokens[i].is("and") && tokens[i - 1].is(",")))
      take_out(tokens, i--, 1);
  for (std::size_t i = 2; i < tokens.size(); ++i) { // `side += 2 tenths`, `for n = 1 to 5 seconds`
    const bool counts =
        holds("tenths units points cm mm deg degrees px", tokens[i].text) ||
        (tokens[0].is("for") && milliseconds_of(tokens[i].text) > 0 && tokens[i].gap);
    const bool ends =
        i + 1 == tokens.size() || tokens[i + 1].is("else") || tokens[i + 1].is("then");
    if (counts && ends && tokens[i - 1].is_number() && tokens[i].is_word() &&
        is_unknown(tokens[i]) && !tokens[0].is("print"))
      take_out(tokens, i--, 1);
  }
  if (tokens.size() > 2 && holds("cm deg degrees px points units", tokens.back().text) &&
      tokens[tokens.size() - 2].is_word() && is_unknown(tokens.back()))
    tokens.pop_back();
  for (std::size_t i = 1; i + 1 < tokens.size() && tokens[0].is("print"); ++i)
    if ((tokens[i].is("and") || tokens[i].is("then")) &&
        (tokens[i - 1].is_text() || tokens[i - 1].is(",") || tokens[i + 1].is_text())) {
      if (tokens[i - 1].is(","))
        tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i--));
      else
        tokens[i] = Token{Token::Kind::Sign, ","};
    }
}

/// `goroll zéro,0,0`
void LineRepair::read_zeros() {
  for (auto& token : parts_.tokens)
    if (is_program() && token.is_word() && holds("zero zéro cero null nul", token.text) &&
        is_foreign(token.text))
      token = Token{Token::Kind::Number, "0", token.gap};
}

/// `PP = W`: a variable whose key was hit twice.
void LineRepair::single_letters() {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 0; i < tokens.size() && judge_.language == Language::Basic; ++i) {
    const auto& text = tokens[i].text;
    if (tokens[i].is_word() && (tokens[i].gap || i == 0) && text.size() == 2 &&
        text[0] == text[1] && to_lower(text[0]) != text[0])
      tokens[i].text.resize(1);
  }
}

/// Brackets and colons that others need: `(print :a :b)`, `call show[]`, `Y += 5 }`, `60: P = 1`.
void LineRepair::drop_brackets() {
  auto& tokens = parts_.tokens;
  if (tokens.size() < 3 || !is_program())
    return;
  if (tokens[0].is("(") && tokens.back().is(")") && holds("print type show pr", tokens[1].text)) {
    tokens.pop_back();
    take_out(tokens, 0, 1);
  }
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
    if (tokens[i].is("[") && tokens[i + 1].is("]") && has_word(names_, tokens[i - 1].text) &&
        !has_word(judge_.words, tokens[i - 1].text)) {
      tokens[i].text = "(";
      tokens[i + 1].text = ")";
    }
  if (tokens.back().is("}") && !tokens[tokens.size() - 2].is(";") && !has_token(tokens, "{"))
    tokens.insert(tokens.end() - 1, Token{Token::Kind::Sign, ";"});
  if (judge_.language == Language::Basic && tokens[0].is(":")) {
    parts_.head += " ";
    tokens.erase(tokens.begin());
  }
}

/// `mín(` where there is `min`.
void LineRepair::without_accents() {
  if (judge_.language == Language::Test)
    return;
  for (auto& token : parts_.tokens)
    if (token.is_word() && std::any_of(token.text.begin(), token.text.end(), is_utf8_tail))
      if (const auto plain = plain_letters(token.text);
          has_word(judge_.words, plain) || has_word(names_, plain))
        token.text = plain;
}

/// `Math.max(`, `Program.best(` and `FNmean` where `max`, `best` and `mean` are known.
void LineRepair::drop_prefixes() {
  auto& tokens = parts_.tokens;
  if (judge_.language == Language::Macro)
    return;
  if (judge_.language == Language::Test)
    return drop_objects();
  const auto own = [&](std::string_view word) { return word.size() > 1 && has_word(names_, word); };
  for (const std::string_view prefix : {"set_", "set"}) { // `set_ledc(3)`
    const std::string_view first = tokens.empty() ? "" : std::string_view(tokens[0].text);
    if (first.size() <= prefix.size() || !equal_words(first.substr(0, prefix.size()), prefix) ||
        !is_foreign(first))
      continue;
    constexpr auto set = std::to_array<std::string_view>({"LEDC", "RGB", "backLED"});
    const auto word = std::find_if(set.begin(), set.end(), [&](std::string_view one) {
      return equal_words(first.substr(prefix.size()), one);
    });
    if (word != set.end())
      tokens[0].text = *word;
  }
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    auto& token = tokens[i];
    if (!token.is_word() || !is_foreign(token.text))
      continue;
    const bool waits = token.is("await") && i + 1 < tokens.size() &&
                       holds("delay sleep wait asyncio", tokens[i + 1].text); // counted in seconds
    if (token.is("await") && !waits && i + 1 < tokens.size() && tokens[i + 1].is_word()) {
      take_out(tokens, i, 1);
      continue;
    }
    const bool member = i + 2 < tokens.size() && tokens[i + 1].is(".") && tokens[i + 2].is_word();
    const bool calls = member && i + 3 < tokens.size() && tokens[i + 3].is("(");
    const bool function =
        calls && (own(tokens[i + 2].text) || holds("abs max min sqrt", tokens[i + 2].text));
    const bool value = member && !calls && i > 0 && has_word(judge_.words, tokens[i + 2].text) &&
                       !find_colour(tokens[i + 2]); // `Ball.accelone`
    if (function || value) {
      take_out(tokens, i, 2);
    } else {
      for (const std::string_view prefix : {"FN", "PROC", "fn", "proc"})
        if (token.text.starts_with(prefix) &&
            own(std::string_view(token.text).substr(prefix.size()))) {
          token.text.erase(0, prefix.size());
          if (i + 1 == tokens.size() || !tokens[i + 1].is("("))
            token.text += "()";
        }
    }
  }
}

/// `Serial.print`, `Program.End()` and `Ball.Toss(820)` as test files say it: no file has such a
/// name.
void LineRepair::drop_objects() {
  auto& tokens = parts_.tokens;
  if (tokens.empty() || tokens[0].is("program") || tokens[0].is("with") || tokens[0].is("course"))
    return;
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i) // `garage.inside`
    if (tokens[i].is_word() && tokens[i + 1].is(".") && !tokens[i + 1].gap &&
        tokens[i + 2].is("inside") && !holds("robot ball sphero bot program", tokens[i].text)) {
      std::swap(tokens[i].text, tokens[i + 2].text);
      tokens[i + 2].gap = true;
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i)
    if (tokens[i].is_word() && tokens[i + 1].is(".") && !tokens[i + 1].gap &&
        tokens[i + 2].is_word() && !tokens[i + 2].is("macro") && !tokens[i + 2].is("test") &&
        !tokens[i].is("not") && (i > 0 || !has_word(judge_.words, tokens[i].text)) &&
        (has_word(judge_.words, tokens[i + 2].text) || is_called("print", tokens[i + 2].text) ||
         is_called("input", tokens[i + 2].text)))
      take_out(tokens, i, 2);
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
    if (tokens[i].is("(") && tokens[i + 1].is(")") && tokens[i - 1].is_word())
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                   tokens.begin() + static_cast<std::ptrdiff_t>(i + 2));
  if (tokens.back().is("?"))
    tokens.pop_back();
}

/// `RGB 0, 60%, 30%` in parts of 255.
void LineRepair::count_percents() {
  auto& tokens = parts_.tokens;
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

/// `isRecord` where the program has `is_record`.
void LineRepair::same_letters() {
  if (judge_.language != Language::Structured)
    return;
  const auto bare = [](std::string_view word) {
    auto letters = lower(word);
    std::erase(letters, '_');
    return letters;
  };
  for (auto& token : parts_.tokens) {
    if (!token.is_word() || !is_foreign(token.text))
      continue;
    const auto own = std::find_if(names_.begin(), names_.end(), [&](std::string_view name) {
      return name != token.text && bare(name) == bare(token.text);
    });
    if (own != names_.end())
      token.text = *own;
  }
}

/// Whether a word is one letter away from one of the language.
bool LineRepair::is_misspelt(std::string_view word) const {
  const auto near = closest(word, judge_.words);
  return near && edit_distance(word, *near) == 1;
}

/// Words of the tables in the form that stands there: `attendez` for `attendre`.
void LineRepair::other_forms() {
  auto& tokens = parts_.tokens;
  if (!tokens.empty() && (tokens[0].is("print") || tokens[0].is("test")))
    return; // words without their quotes
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const bool named =
        (i + 1 < tokens.size() && (tokens[i + 1].is("=") || tokens[i + 1].is("."))) ||
        (i > 0 && tokens[i - 1].is("."));
    if (!tokens[i].is_word() || named || !is_foreign(tokens[i].text) ||
        milliseconds_of(tokens[i].text) > 0 || find_colour(tokens[i]) ||
        is_misspelt(tokens[i].text) || is_known_word(tokens[i].text, Where::Line) ||
        is_known_word(tokens[i].text, Where::Inside))
      continue;
    if (const auto form = known_form_of(tokens[i].text, judge_.language); !form.empty())
      tokens[i].text = form;
  }
}

/// `A% = B%`: signs behind a variable that tell its type elsewhere.
void LineRepair::drop_sigils() {
  auto& tokens = parts_.tokens;
  const auto names_variable = [&](const Token& token) {
    return token.is_word() && (token.text.size() == 1 || (judge_.language == Language::Structured &&
                                                          has_word(around_.elsewhere, token.text)));
  };
  if (!is_program())
    return;
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

/// `if it is lit then` of a variable.
void LineRepair::drop_pronoun(const Scenery& scenery) {
  auto& tokens = parts_.tokens;
  if (tokens.size() > 3 && holds("if while until", tokens[0].text) && tokens[1].is("it") &&
      tokens[2].is("is") && has_word(names_, tokens[3].text) && !scenery.is_sub(tokens[3].text))
    take_out(tokens, 1, 2);
}

/// `values(3)` of an array becomes `values[3]`.
void LineRepair::index_arrays(const Scenery& scenery) {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    if (!tokens[i].is("(") || !tokens[i - 1].is_word() || !scenery.is_array(tokens[i - 1].text))
      continue;
    const auto end = close_of(tokens, i);
    if (end == tokens.size())
      return;
    tokens[i].text = "[";
    tokens[i].gap = false;
    tokens[end].text = "]";
  }
}

/// Jumps to labels, as other languages have them, become jumps to their lines.
void LineRepair::resolve_labels(const Scenery& scenery) {
  auto& tokens = parts_.tokens;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const bool jumps = equal_words(tokens[i].text, "goto") || equal_words(tokens[i].text, "gosub");
    if (!jumps || !tokens[i + 1].is_word())
      continue;
    if (const auto number = scenery.number_of(tokens[i + 1].text); !number.empty())
      tokens[i + 1].text = number;
  }
}

} // namespace orb::repair
