#include "repair/line_repair.h"

#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/gist.h"
#include "repair/units.h"

#include <algorithm>

// What is tried where no row fits a line: what its words are about, and what is left of it without
// words, units and names that say nothing here.

namespace orb::repair {

/// `Down = 255 - Up` in a program that uses `D` and `U`; `13o delay 500` is `130 delay 500`.
void LineRepair::by_initials() {
  auto tokens = parts_.tokens;
  bool any = false;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    auto& token = tokens[i];
    if (!token.is_word() || token.text.size() < 2 || !is_foreign(token.text))
      continue;
    const bool after_value =
        i > 0 &&
        (tokens[i - 1].is_number() || tokens[i - 1].is_text() || tokens[i - 1].text.size() == 1) &&
        tokens[i - 1].kind != Token::Kind::Sign;
    if (after_value || is_called("", token.text))
      return; // `print 3 throws`: a word more, no value
    const std::string initial(1, to_upper(token.text[0]));
    if (!is_letter(initial[0]) ||
        std::find(letters_.begin(), letters_.end(), initial) == letters_.end())
      return;
    token.text = initial;
    any = true;
  }
  if (any)
    attempt(join(tokens), {}, false);
}

/// `RGB red delay 1s`: statements behind each other, each on a line of its own.
void LineRepair::one_by_one() {
  const auto& tokens = parts_.tokens;
  const bool numbered = judge_.language == Language::Basic;
  if ((!numbered && judge_.language != Language::Structured) || has_token(tokens, "then"))
    return;
  const auto begins = [&](Tokens::const_iterator at) {
    const bool sets = tokens.end() - at > 2 && at->is_word() && (at + 1)->is("=");
    return sets || (has_word(judge_.words, at->text) &&
                    !holds("repeat until while loop for next if else elseif select case sub "
                           "function end exit continue return goto gosub to step then",
                           at->text));
  };
  std::string lines;
  auto begin = tokens.begin();
  for (auto at = begin + 1; at <= tokens.end(); ++at) {
    const Tokens part(begin, at);
    if ((at != tokens.end() && !begins(at)) || !begins(begin) ||
        !judge_.parses(parts_.head + join(part)))
      continue;
    lines += (lines.empty() ? "" : "\n") + join(part);
    begin = at;
    if (at == tokens.end())
      break;
  }
  if (begin == tokens.end() && lines.find('\n') != std::string::npos)
    attempt(lines, {}, true);
}

/// `i` for `next i`, and `count 0` for `count = 0`.
void LineRepair::by_words_left_out() {
  const auto& tokens = parts_.tokens;
  if (tokens.size() == 1 && tokens[0].text == around_.loop) {
    attempt("next " + around_.loop, {}, false);
    return;
  }
  const auto names = [&](const Token& token) {
    return judge_.language == Language::Basic ? is_letter(token.text[0]) && token.text.size() == 1
                                              : has_word(names_, token.text);
  };
  if (tokens.size() == 2 && tokens[0].is_word() && names(tokens[0]) &&
      (tokens[1].is_number() || tokens[1].is_word()))
    attempt(join({tokens[0]}) + " = " + tokens[1].text, {}, false);
}

/// A unit where none is counted (`score += 5 points`, `if s > longest steps then`), names of values
/// (`leg(towards=90)`), and a quantity behind a statement that takes none.
void LineRepair::by_leaving_out() {
  const auto& all = parts_.tokens;
  const auto operand = [&](std::size_t at) {
    return all[at].is_number() || all[at].is(")") || (all[at].is_word() && !is_unknown(all[at]));
  };
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool unit = all[i].is("%") || all[i].is("cm") || all[i].is("m") || all[i].is("x");
    const bool time = all[i].is_word() && milliseconds_of(all[i].text) > 0;
    const bool compared = i > 1 && all[i - 2].is_relation() && !all[1].is("=");
    const bool plain = all[i - 1].is_word() || compared ||
                       all[i - 1].is("0"); // else which unit was meant is not clear
    if (all[i].is("%") && all[i - 1].is_number() && !all[i - 1].is("0"))
      continue; // of what?
    if (!operand(i - 1) || !(time ? plain : unit || is_unknown(all[i])))
      continue;
    auto less = all;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    if (attempt(join(less), {}, false))
      return;
  }
  const auto is_unit = [&](const Token& token) { // `20pts`, `N < 1 sticks or N > 3 sticks`
    const auto same = std::count_if(all.begin(), all.end(), [&](const Token& other) {
      return other.is_word() && other.text == token.text;
    });
    return (same > 1 || !token.gap) && is_unknown(token);
  };
  auto bare = all;
  for (std::size_t i = 1; i < bare.size(); ++i) { // `90deg,70%,1s`
    const bool unit = bare[i - 1].is_number() &&
                      (is_unit(bare[i]) || bare[i].is("%") || bare[i].is("cm") || bare[i].is("m") ||
                       holds("rad radians", bare[i].text) || is_called("degrees", bare[i].text) ||
                       (bare[i].is_word() && milliseconds_of(bare[i].text) > 0));
    const bool per = unit && i + 2 < bare.size() && bare[i + 1].is("/") && bare[i + 2].is("s");
    if (unit)
      bare.erase(bare.begin() + static_cast<std::ptrdiff_t>(i),
                 bare.begin() + static_cast<std::ptrdiff_t>(i + (per ? 3 : 1)));
  }
  if (bare.size() + 1 < all.size() && attempt(join(bare), {}, false))
    return;
  auto unnamed = all;
  for (std::size_t i = 2; i + 1 < unnamed.size(); ++i)
    if (unnamed[i].is("=") && unnamed[i - 1].is_word() &&
        (unnamed[i - 2].is("(") || unnamed[i - 2].is(","))) {
      unnamed.erase(unnamed.begin() + static_cast<std::ptrdiff_t>(i) - 1,
                    unnamed.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      i -= 2;
    }
  if (unnamed.size() < all.size() && all.size() > 2 && all[1].is("(") &&
      attempt(join(unnamed), {}, false))
    return;
  if (std::any_of(all.begin(), all.end(), [](const Token& token) { return token.is("print"); }))
    return; // a number may be how often
  const auto size = all.size();
  for (const std::size_t count : {1U, 2U}) // `flicker 12 times`, `expect reach goal 1m`
    if (size > count && all[size - count].is_number() && !all[1].is("=") &&
        (count == 1 ? !all[size - 2].is_word() || size == 2 : all.back().is_word()) &&
        attempt(join(Tokens(all.begin(), all.end() - static_cast<std::ptrdiff_t>(count))), {},
                false))
      return;
}

/// What the words are about.
void LineRepair::by_gist() {
  if (judge_.language == Language::Basic || judge_.language == Language::Structured)
    for (const auto& one : gist_of(parts_.tokens, around_))
      attempt(one, {}, false);
}

/// A statement that has words before or behind it that nobody knows: `well, goto 20 again`.
void LineRepair::among_unknown() {
  constexpr std::size_t most = 3; // such words on either side
  const auto& all = parts_.tokens;
  const auto at = [&](std::size_t place) {
    return all.begin() + static_cast<std::ptrdiff_t>(place);
  };
  for (std::size_t front = 0; front < all.size() && front <= most; ++front) {
    if (front > 0 && !is_unknown(all[front - 1]))
      return;
    const bool orders_words = judge_.rephrase != nullptr; // what stands behind is put in its place
    if (orders_words && !has_word(judge_.words, all[front].text))
      continue;
    const auto shortest =
        orders_words ? all.size() - 1 : all.size() - std::min(all.size(), most + 1);
    for (auto end = all.size(); end > front + 1 && end > shortest; --end) {
      if (end < all.size() && !is_unknown(all[end]))
        break;
      if (end - front == all.size())
        continue;
      const Tokens rest(at(front), at(end));
      if (attempt(join(rest), {}, false) || rephrase(rest))
        return;
      const bool own = rest.size() > 2 && rest[1].is_word() && !is_foreign(rest[0].text);
      if (rest[0].text.size() == 1 || !(own || has_word(judge_.words, rest[0].text)))
        continue;                     // what is left is no statement
      constexpr std::size_t few = 40; // more states
      habits(join(rest), {2, seen_.size() + few});
      if (best_) {
        best_->sure = false;
        return;
      }
    }
  }
}

} // namespace orb::repair
