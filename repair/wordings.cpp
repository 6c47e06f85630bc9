#include "repair/normalise.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/called.h"
#include "repair/colours.h"
#include "repair/inflections.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

// Filler words, and inflected words.

namespace orb::repair {
/// `let the course be 0`, `print "I take" and then N`, `read v cm`: filler words.
void drop_small_words(Line& line) {
  auto& tokens = line.tokens;
  const auto is_said = [&](const Token& token) { // `print the end`
    return tokens[0].is("print") && line.knows(token.text) &&
           !line.dialect->parses(line.head + "print " + token.text);
  };
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
    if ((tokens[i].is("the") && !line.has_name("the") && !is_said(tokens[i + 1])) ||
        (tokens[i].is("and") && tokens[i - 1].is(",")))
      take_out(tokens, i--, 1);
  for (std::size_t i = 2; i < tokens.size(); ++i) { // `side += 2 tenths`, `for n = 1 to 5 seconds`
    const bool counts =
        holds("tenths units points cm mm deg degrees px", tokens[i].text) ||
        (tokens[0].is("for") && milliseconds_of(tokens[i].text) > 0 && tokens[i].gap);
    const bool ends =
        i + 1 == tokens.size() || tokens[i + 1].is("else") || tokens[i + 1].is("then");
    if (counts && ends && tokens[i - 1].is_number() && tokens[i].is_word() &&
        line.is_unknown(tokens[i]) && !tokens[0].is("print"))
      take_out(tokens, i--, 1);
  }
  if (tokens.size() > 2 && holds("cm deg degrees px points units", tokens.back().text) &&
      tokens[tokens.size() - 2].is_word() && line.is_unknown(tokens.back()))
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

/// `Math.max(`, `Program.best(` and `FNmean` if `max`, `best` and `mean` are known.
void drop_prefixes(Line& line) {
  auto& tokens = line.tokens;
  const auto own = [&](std::string_view word) { return word.size() > 1 && line.has_name(word); };
  for (const std::string_view prefix : {"set_", "set"}) { // `set_ledc(3)`
    const std::string_view first = tokens.empty() ? "" : std::string_view(tokens[0].text);
    if (first.size() <= prefix.size() || !equal_words(first.substr(0, prefix.size()), prefix) ||
        !line.is_foreign(first))
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
    if (!token.is_word() || !line.is_foreign(token.text))
      continue;
    const bool waits = token.is("await") && i + 1 < tokens.size() &&
                       holds("delay sleep wait asyncio", tokens[i + 1].text); // counted in seconds
    if (token.is("await") && !waits && i + 1 < tokens.size() && tokens[i + 1].is_word()) {
      take_out(tokens, i--, 1);
      continue;
    }
    const bool member = i + 2 < tokens.size() && tokens[i + 1].is(".") && tokens[i + 2].is_word();
    const bool calls = member && i + 3 < tokens.size() && tokens[i + 3].is("(");
    const bool function =
        calls && (own(tokens[i + 2].text) || holds("abs max min sqrt", tokens[i + 2].text));
    const bool value = member && !calls && i > 0 && line.knows(tokens[i + 2].text) &&
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

namespace {

/// True if a word is one letter away from a word of the language.
bool is_misspelt(const Line& line, std::string_view word) {
  const auto near = closest(word, line.dialect->words);
  return near && edit_distance(word, *near) == 1;
}

} // namespace

/// Replaces inflected words by the form in the tables: `attendez` by `attendre`.
void other_forms(Line& line) {
  auto& tokens = line.tokens;
  if (!tokens.empty() && (tokens[0].is("print") || tokens[0].is("test")))
    return; // unquoted words
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const bool named =
        (i + 1 < tokens.size() && (tokens[i + 1].is("=") || tokens[i + 1].is("."))) ||
        (i > 0 && tokens[i - 1].is("."));
    if (!tokens[i].is_word() || named || !line.is_foreign(tokens[i].text) ||
        std::any_of(tokens[i].text.begin(), tokens[i].text.end(), is_digit) || // `delay1s`
        milliseconds_of(tokens[i].text) > 0 || find_colour(tokens[i]) ||
        is_misspelt(line, tokens[i].text) || is_known_word(tokens[i].text, Where::Line) ||
        is_known_word(tokens[i].text, Where::Inside))
      continue;
    if (const auto form = known_form_of(tokens[i].text, line.language()); !form.empty())
      tokens[i].text = form;
  }
}

/// Applies the documented spelling where case counts on the robot.
void documented_spelling(Line& line) {
  const auto& words = line.dialect->words;
  for (auto& token : line.tokens) {
    if (!token.is_word() || std::find(words.begin(), words.end(), token.text) != words.end())
      continue;
    const auto same = std::find_if(words.begin(), words.end(), [&](std::string_view one) {
      return one.size() > 1 && equal_words(one, token.text);
    });
    if (same != words.end())
      token.text = *same;
  }
}

/// Replaces words by a name of the program with the same meaning: `Richtung` by `direction`.
void own_words(Line& line) {
  auto tokens = line.tokens;
  bool any = false;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    auto& token = tokens[i];
    const bool acts = i == 0 && !(tokens.size() > 1 && tokens[1].is("="));
    const bool unit = i > 0 && tokens[i - 1].is_number();
    if (acts || unit || !token.is_word() || holds("true false on off", token.text) ||
        milliseconds_of(token.text) > 0 || meanings_of(token.text).empty() ||
        !line.is_foreign(token.text) || is_known_word(token.text, Where::Line))
      continue;
    const auto own = std::find_if(line.names.begin(), line.names.end(), [&](std::string_view name) {
      return milliseconds_of(name) == 0 && !line.knows(name) && mean_the_same(name, token.text);
    });
    const bool said =
        own != line.names.end() && i + 1 < tokens.size() && tokens[i + 1].text == *own;
    if (own == line.names.end() || said) // `direction course` already names it
      continue;
    token.text = *own;
    any = true;
  }
  if (!any || tokens[0].is("print")) // words are printed
    return;
  line.tokens = std::move(tokens);
  line.incomplete = true;
}

} // namespace orb::repair
