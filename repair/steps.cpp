#include "repair/trial.h"

#include "base/duration.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/fill.h"
#include "repair/gist.h"
#include "repair/inflections.h"
#include "repair/normalise.h"
#include "repair/quotes.h"
#include "repair/search.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

// The steps that propose lines: the most informative come first, guesses last.

namespace orb::repair {
namespace {

constexpr std::size_t most_states = 90; // of one line, by rows
constexpr std::size_t few_states = 40;
constexpr int most_candidates = 1000; // of one line, by changes
constexpr int deepest = 6;            // rows in one line
constexpr int surely = 6;             // the cost of one letter of a word
constexpr int slip = 9;               // the maximum cost of one typo
constexpr int any_cost = 1000;
constexpr int clearly = 4; // margin of the best change over the next

/// Tells if later steps may improve the result.
enum class Next : std::uint8_t { GoOn, Enough };

Next enough_if(bool enough) {
  return enough ? Next::Enough : Next::GoOn;
}

/// A statement that is only a guess.
Candidate guess(std::string text) {
  return {std::move(text), 0, nullptr, false};
}

const Token& first_of(const Line& line) {
  static const Token none;
  return line.tokens.empty() ? none : line.tokens[0];
}

/// True if a text can only be a file name.
bool names_a_file(std::string_view text) {
  return text.find(' ') == std::string_view::npos && text.find('.') != std::string_view::npos;
}

/// True if the proposal begins with the same word as the line.
bool begins_alike(const Line& line, std::string_view lines) {
  const auto& word = line.tokens.front().text;
  const auto begin = lines.substr(std::min(line.head.size(), lines.size()));
  return begin.starts_with(word) && begin.substr(word.size()).starts_with(' ');
}

/// Proposes the values in the documented order; returns true if nothing can be better.
bool in_order(Trial& trial, const Tokens& tokens) {
  const auto& rephrase = trial.line().dialect->rephrase;
  if (!rephrase || tokens.empty())
    return false;
  for (const auto& one : rephrase(tokens)) {
    if (!trial.offer({one.text, 0, nullptr, one.sure}))
      continue;
    if (!one.other.empty())
      trial.offer_other(one.other);
    return true;
  }
  return false;
}

/// Applies rows until one gives a valid line.
void apply_rows(Trial& trial, const std::string& statement, Bounds bounds) {
  trial.explore_rows(statement, bounds, trial.seen(), [&](const Candidate& one) {
    return trial.offer(one) || in_order(trial, tokens_of(one.text, trial.line().language()));
  });
}

/// The result of the finding's own fix, if an earlier step computed it.
struct OwnFix {
  std::optional<std::string> line;
  bool safe = false;
  bool leaves_out = false; ///< a word that another language needs, although the line says more
};

OwnFix own_fix(const Trial& trial) {
  const auto& line = trial.line();
  const auto& finding = trial.finding();
  OwnFix own{fixed(line, finding)};
  if (!own.line)
    return own;
  const auto& edit = finding.fix->edits.front();
  own.safe = finding.fix->safety == Safety::Safe;
  const auto was = line.written.substr(edit.span.begin - line.begin, edit.span.size());
  if (const bool shortens = !edit.text.empty() && was.size() == edit.text.size() + 1 &&
                            was.starts_with(edit.text) && is_letter(was[0]);
      shortens && line.knows(edit.text))
    return {}; // it drops a value: `printn`
  own.leaves_out = edit.text.empty() && edit.span.size() > 0 && is_letter(was[0]) &&
                   own.line->find_first_not_of(" \t;", line.head_size) != std::string::npos;
  return own;
}

/// True if the line calls a sub of the program, or returns: idioms do not apply then.
bool calls(const Line& line) {
  return (!line.sub.empty() && first_of(line).text == line.sub) ||
         (line.tokens.size() == 1 && line.tokens[0].is("return"));
}

bool is_known_first(const Line& line) {
  return is_known_word(first_of(line).text, Where::Line);
}

// ---- the steps

/// `0 200 255` in a macro: values without their command.
Next forgotten_command(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  if (std::any_of(tokens.begin(), tokens.end(),
                  [](const Token& token) { return !token.is_number() && !token.is(","); }))
    return Next::GoOn;
  const auto values = tokens.size() - static_cast<std::size_t>(line.count_of(","));
  const auto text = join(tokens);
  if (values == 4)
    trial.offer(guess("fade " + text));
  if (values == 3) {
    trial.offer(guess("rgb " + text));
    if (trial.found())
      trial.offer_other("roll " + text);
  }
  return enough_if(trial.found());
}

/// The number of a line in two parts, below a greater one: `1 10 return` and `5O delay 130`.
Next split_number(Trial& trial) {
  const auto& line = trial.line();
  const auto& own = line.around.line_number;
  if (line.tokens.size() < 2 || own.empty())
    return Next::GoOn;
  const auto& next = line.tokens[0];
  const auto digits = next.is_number() || next.gap ? next.text : as_digits(next.text);
  const auto written = parse_number<std::uint32_t>(own);
  const auto joined = parse_number<std::uint32_t>(own + digits);
  const auto above = parse_number<std::uint32_t>(line.number_above);
  const auto below = parse_number<std::uint32_t>(line.around.number_below);
  if (!written || !joined || above.value_or(0) < *written || above.value_or(0) >= *joined ||
      below.value_or(*joined + 1) <= *joined)
    return Next::GoOn;
  const auto indent = line.written.substr(0, line.written.find_first_not_of(" \t"));
  trial.offer_lines(guess(std::string(indent) + own + digits + " " + join(slice(line.tokens, 1)) +
                          (line.comment.empty() ? "" : " ") + line.comment));
  return enough_if(trial.found());
}

/// `endrepeta`, `ensub` and `sub end`: the end of the innermost block.
Next misspelt_end(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  const auto end = tokens_of(line.around.closer, line.language());
  if (end.size() != 2 || tokens.empty() || tokens.size() > 2 || !tokens.back().is_word())
    return Next::GoOn;
  const bool exchanged = tokens.size() == 2 && tokens[1].is("end") &&
                         holds("if while loop repeat sub function select", tokens[0].text);
  constexpr std::size_t most = 2; // wrong letters
  const auto distance = edit_distance(tokens[0].text + (tokens.size() == 2 ? tokens[1].text : ""),
                                      end[0].text + end[1].text);
  if (exchanged || (distance <= most && !line.is_elsewhere(tokens[0].text)))
    trial.offer(guess(exchanged ? "end " + tokens[0].text : line.around.closer));
  return enough_if(trial.found());
}

/// `end` in a macro for the end of its block.
Next bare_end(Trial& trial) {
  const auto& line = trial.line();
  if (line.tokens.size() == 1 && !line.around.closer.empty() &&
      holds("loop end next repeat", line.tokens[0].text))
    trial.offer(guess(line.around.closer));
  return Next::GoOn;
}

/// `"goes home"` and `comprobar "goes home"`: the title of a test.
Next test_title(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  const bool bare = tokens.size() == 1 && tokens[0].is_text();
  const bool behind_word = tokens.size() == 2 && tokens[1].is_text() && tokens[0].is_word() &&
                           line.is_foreign(tokens[0].text) && !names_a_file(tokens[1].text) &&
                           !is_called("print", tokens[0].text);
  if (line.head.empty() && (bare || behind_word))
    trial.offer(guess("test " + join({tokens.back()})));
  return Next::GoOn;
}

/// `RGB red delay 1s`: several statements, one line each.
Next one_by_one(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  if (tokens.empty() || has_token(tokens, "then"))
    return Next::GoOn;
  const auto begins = [&](Tokens::const_iterator at) {
    const bool sets = tokens.end() - at > 2 && at->is_word() && (at + 1)->is("=");
    return sets || (line.knows(at->text) &&
                    !holds("repeat until while loop for next if else elseif select case sub "
                           "function end exit continue return goto gosub to step then",
                           at->text));
  };
  std::string lines;
  auto begin = tokens.begin();
  for (auto at = begin + 1; at <= tokens.end(); ++at) {
    const Tokens part(begin, at);
    const bool twice = at != tokens.end() && part.size() == 1 && at->text == part[0].text;
    const bool ends = at == tokens.end();
    if (!twice && (ends || begins(at)) && begins(begin) && // `print print "x"`
        line.dialect->parses(line.head + join(part))) {
      lines += (lines.empty() ? "" : "\n") + join(part);
      begin = at;
    }
    if (ends)
      break;
  }
  if (begin == tokens.end() && lines.find('\n') != std::string::npos)
    trial.offer({lines});
  return enough_if(trial.found());
}

/// The same words in another order are the best proposal, whatever else the finding says.
Next other_order(Trial& trial) {
  const auto& line = trial.line();
  return enough_if(in_order(trial, line.tokens) ||
                   (trial.found() && begins_alike(line, trial.best()->text)));
}

/// One quote too many or too few.
Next one_quote(Trial& trial) {
  for (const auto& text : with_one_quote(trial.line()))
    if (!trial.found())
      trial.offer({text});
    else if (!trial.other())
      trial.offer_other(text);
  return enough_if(trial.found());
}

Next one_bracket(Trial& trial) {
  if (const auto closed = with_bracket(trial.line()); !closed.empty())
    trial.offer({closed});
  return Next::GoOn;
}

/// `drive 0, 1s`, `call drive(0, 1s)` and `wait for shake` if the program has a sub of that name,
/// which takes precedence over idioms.
Next own_call(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  if (line.sub.empty() || tokens.size() < 2)
    return Next::GoOn;
  const bool spread = tokens[0].text != line.sub && tokens[1].text != line.sub;
  const bool adds_words = tokens[0].text == line.sub &&
                          std::all_of(tokens.begin() + 1, tokens.end(), [&](const Token& token) {
                            return line.is_unknown(token) || token.is_number();
                          });
  if ((spread || adds_words) && trial.offer({line.sub}))
    return Next::GoOn;
  std::unordered_set<std::string> seen;
  trial.explore_rows(join(tokens), {1, few_states}, seen, [&](const Candidate& one) {
    return one.text.starts_with(line.sub + "(") && trial.offer(one);
  });
  return Next::GoOn;
}

/// `colore(i)` if there is a `colour`; `trazo(90)` if `stroke` is the only uncalled sub, or the
/// only one with one value.
Next own_sub(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  const bool called =
      tokens.size() == 1 || (tokens.size() > 2 && tokens[1].is("(") && tokens.back().is(")"));
  if ((line.meant.empty() && line.like.empty()) || !called || !tokens[0].is_word() ||
      !line.is_foreign(tokens[0].text))
    return Next::GoOn;
  if (line.like.empty() &&
      (is_known_first(line) || !known_form_of(tokens[0].text, line.language()).empty()))
    return Next::GoOn;
  auto call = tokens;
  call[0].text = line.like.empty() ? line.meant : line.like;
  trial.offer(guess(join(call)));
  return Next::GoOn;
}

/// The finding names the missing value of a call, which takes precedence over idioms.
Next missing_value(Trial& trial) {
  return enough_if(calls(trial.line()) && trial.finding().rule->trouble == Trouble::ArgumentCount);
}

/// The finding's own fix.
Next by_fix(Trial& trial) {
  const auto& line = trial.line();
  const auto own = own_fix(trial);
  if (!own.line)
    return Next::GoOn;
  const auto accepted = trial.offer_lines({*own.line, 0, nullptr, own.safe});
  if (accepted && accepted->errors > 0)
    trial.offer_declared_otherwise(own.line->substr(std::min(line.head_size, own.line->size())));
  return Next::GoOn;
}

/// The finding's own fix of an unknown word: it knows the names and the blocks.
Next by_fix_of_name(Trial& trial) {
  const auto own = own_fix(trial);
  return own.line && !own.leaves_out && !trial.line().has_foreign(*own.line) &&
                 is_unknown(trial.finding())
             ? by_fix(trial)
             : Next::GoOn;
}

/// The normalised line.
Next as_read(Trial& trial) {
  const auto& line = trial.line();
  const bool filled = std::any_of(line.tokens.begin(), line.tokens.end(), [](const Token& token) {
    return token.is_text() && token.text.find("${") != std::string::npos; // `${N} tries`
  });
  auto text = join(line.tokens);
  if (!filled && line.with(text) != line.written)
    trial.offer({std::move(text), 0, nullptr, !line.incomplete});
  return Next::GoOn;
}

/// A guess from the topics of the words.
Next by_gist(Trial& trial) {
  for (auto& one : gist_of(trial.line().tokens, trial.line().around))
    trial.offer(guess(std::move(one)));
  return Next::GoOn;
}

/// Small changes to a line; two proposals if the intent is ambiguous.
class Nearest {
public:
  Nearest(Trial& trial, int most) : trial_(trial), line_(trial.line()), most_(most) {}

  void find() {
    auto& near = trial_.changes().near;
    if (near.empty())
      near = changes_of(line_.tokens);
    const auto end = std::find_if(near.begin(), near.end(),
                                  [&](const Candidate& one) { return one.cost > most_; });
    const auto first =
        std::span<const Candidate>(near).first(static_cast<std::size_t>(end - near.begin()));
    for (const auto& one : first)
      consider(one);
    if (good_.empty() && most_ > surely)
      twice(first);
    if (!good_.empty())
      trial_.best() = good_[0].second;
    if (good_.size() > 1)
      trial_.other() = good_[1].second;
  }

private:
  std::vector<Candidate> changes_of(const Tokens& tokens) const {
    return changes(tokens, line_.language(), line_.dialect->words, line_.names);
  }

  void twice(std::span<const Candidate> first) {
    for (const auto& one : first) {
      if (one.cost > slip || tried_ > most_candidates)
        return;
      for (auto next : changes_of(tokens_of(one.text, line_.language()))) {
        next.cost += one.cost;
        if (next.cost > 2 * slip)
          break;
        consider(next);
      }
    }
  }

  void consider(const Candidate& one) {
    if (!good_.empty() && one.cost > good_.front().first.cost + clearly)
      return;
    if (++tried_ > most_candidates || good_.size() > 1 ||
        !trial_.changes().seen.insert(one.text).second)
      return;
    auto lines = one;
    lines.text = line_.with(one.text);
    lines.sure = one.cost <= slip;
    if (auto accepted = trial_.check(lines)) {
      good_.emplace_back(one, *std::move(accepted));
      return;
    }
    if (one.cost > slip || !good_.empty() || most_ == surely)
      return;
    // a row, misspelt
    trial_.best().reset();
    apply_rows(trial_, one.text, {3, trial_.seen().size() + 8});
    if (trial_.found())
      good_.emplace_back(one, *trial_.best());
    trial_.best().reset();
  }

  Trial& trial_;
  const Line& line_;
  int most_;
  int tried_ = 0;
  std::vector<std::pair<Candidate, Accepted>> good_;
};

void by_changes(Trial& trial, int most) {
  const auto& line = trial.line();
  // No change of this line alone can repair a long name, which must become a letter.
  if (line.language() != Language::Basic || !holds_name(line.tokens, line.around))
    Nearest(trial, most).find();
}

/// Typos in a word.
Next by_letters(Trial& trial) {
  if (!is_known_first(trial.line()))
    by_changes(trial, surely);
  return Next::GoOn;
}

Next by_all_changes(Trial& trial) {
  by_changes(trial, any_cost);
  return Next::GoOn;
}

Next by_rows(Trial& trial) {
  const bool test = trial.line().language() == Language::Test;
  apply_rows(trial, join(trial.line().tokens), {deepest, test ? few_states : most_states});
  return Next::GoOn;
}

/// `i` for `next i`, and `count 0` for `count = 0`.
Next words_left_out(Trial& trial) {
  const auto& line = trial.line();
  const auto& tokens = line.tokens;
  if (tokens.size() == 1 && tokens[0].text == line.around.loop) {
    trial.offer(guess("next " + line.around.loop));
    return Next::GoOn;
  }
  const auto names = [&](const Token& token) {
    return line.language() == Language::Basic ? is_letter(token.text[0]) && token.text.size() == 1
                                              : line.has_name(token.text);
  };
  if (tokens.size() == 2 && tokens[0].is_word() && names(tokens[0]) &&
      (tokens[1].is_number() || tokens[1].is_word()))
    trial.offer(guess(join({tokens[0]}) + " = " + tokens[1].text));
  return Next::GoOn;
}

/// `print C primes`: unknown words at the end are a text.
Next text_unquoted(Trial& trial) {
  const auto& line = trial.line();
  const auto& all = line.tokens;
  auto begin = all.size();
  while (begin > 0 && line.is_unknown(all[begin - 1]))
    --begin;
  if (begin < 2 || begin == all.size() || !all[0].is("print"))
    return Next::GoOn;
  auto text = word(" " + join(slice(all, begin)));
  text.kind = Token::Kind::Text;
  auto whole = slice(all, 0, begin);
  whole.push_back(text);
  trial.offer(guess(join(whole)));
  return enough_if(trial.found());
}

/// A statement between unknown words: `well, goto 20 again`.
Next among_unknown(Trial& trial) {
  constexpr std::size_t most = 3; // such words on either side
  const auto& line = trial.line();
  const auto& all = line.tokens;
  for (std::size_t front = 0; front < all.size() && front <= most; ++front) {
    if (front > 0 && !line.is_unknown(all[front - 1]))
      return Next::GoOn;
    const bool orders_words =
        line.dialect->rephrase != nullptr; // it puts the words that follow in order
    if (orders_words && !line.knows(all[front].text))
      continue;
    const auto shortest =
        orders_words ? all.size() - 1 : all.size() - std::min(all.size(), most + 1);
    for (auto end = all.size(); end > front + 1 && end > shortest; --end) {
      if (end < all.size() && !line.is_unknown(all[end]))
        break;
      if (end - front == all.size())
        continue;
      const auto rest = slice(all, front, end);
      if (trial.offer(guess(join(rest))) || in_order(trial, rest))
        return Next::GoOn;
      const bool own = rest.size() > 2 && rest[1].is_word() && rest[0].is_word() &&
                       !line.is_foreign(rest[0].text);
      if (rest[0].text.size() == 1 || !(own || line.knows(rest[0].text)))
        continue; // the rest is not a statement
      apply_rows(trial, join(rest), {2, trial.seen().size() + few_states});
      if (trial.found()) {
        trial.best()->sure = false;
        return Next::GoOn;
      }
    }
  }
  return Next::GoOn;
}

/// Removes each unknown unit alone: `score += 5 points`, `if s > longest steps then`.
Next without_unit(Trial& trial) {
  const auto& line = trial.line();
  const auto& all = line.tokens;
  const auto operand = [&](std::size_t at) {
    return all[at].is_number() || all[at].is(")") ||
           (all[at].is_word() && !line.is_unknown(all[at]));
  };
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool unit = all[i].is("%") || all[i].is("cm") || all[i].is("m") || all[i].is("x");
    const bool time = all[i].is_word() && milliseconds_of(all[i].text) > 0;
    const bool compared = i > 1 && all[i - 2].is_relation() && !all[1].is("=");
    const bool plain = all[i - 1].is_word() || compared ||
                       all[i - 1].is("0"); // for other numbers the unit would be ambiguous
    if (all[i].is("%") && all[i - 1].is_number() && !all[i - 1].is("0"))
      continue; // the noun is unknown
    if (!operand(i - 1) || !(time ? plain : unit || line.is_unknown(all[i])) ||
        looks_like_digits(all[i].text))
      continue;
    auto less = all;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    if (trial.offer(guess(join(less))))
      break;
  }
  return Next::GoOn;
}

/// Removes all units: `90deg,70%,1s`.
Next without_units(Trial& trial) {
  const auto& line = trial.line();
  const auto& all = line.tokens;
  const auto is_unit = [&](const Token& token) { // `20pts`, `N < 1 sticks or N > 3 sticks`
    return (line.count_of(token.text) > 1 || !token.gap) && line.is_unknown(token) &&
           !looks_like_digits(token.text);
  };
  auto bare = all;
  for (std::size_t i = 1; i < bare.size(); ++i) {
    const bool unit = bare[i - 1].is_number() &&
                      (is_unit(bare[i]) || bare[i].is("%") || bare[i].is("cm") || bare[i].is("m") ||
                       holds("rad radians", bare[i].text) || is_called("degrees", bare[i].text) ||
                       (bare[i].is_word() && milliseconds_of(bare[i].text) > 0));
    const bool per = unit && i + 2 < bare.size() && bare[i + 1].is("/") && bare[i + 2].is("s");
    if (unit)
      bare.erase(bare.begin() + static_cast<std::ptrdiff_t>(i),
                 bare.begin() + static_cast<std::ptrdiff_t>(i + (per ? 3 : 1)));
  }
  if (bare.size() + 1 < all.size())
    trial.offer(guess(join(bare)));
  return Next::GoOn;
}

/// Removes a quantity after a statement that takes none: `flicker 12 times`, `expect reach goal
/// 1m`.
Next without_quantity(Trial& trial) {
  const auto& all = trial.line().tokens;
  if (has_token(all, "print"))
    return Next::GoOn; // a number may be a count
  const auto size = all.size();
  for (const std::size_t count : {1U, 2U})
    if (size > count && all[size - count].is_number() && !all[1].is("=") &&
        (count == 1 ? !all[size - 2].is_word() || size == 2 : all.back().is_word()) &&
        trial.offer(guess(join(slice(all, 0, size - count)))))
      break;
  return Next::GoOn;
}

/// Adds a proposal in milliseconds if a time was read as seconds: for larger numbers both are
/// likely.
Next in_milliseconds(Trial& trial) {
  constexpr int few = 5;
  constexpr int half_second = 30; // sixtieths
  constexpr int most_ticks = 600;
  const auto& tokens = trial.line().tokens;
  if (!trial.found() || trial.other())
    return Next::GoOn;
  const auto& best = trial.best()->text;
  const auto offer = [&](std::string text) {
    trial.other() =
        trial.check({.text = std::move(text), .why = trial.best()->note, .sure = false});
    return Next::GoOn;
  };
  constexpr std::string_view in_seconds = " * 1000";
  if (best.ends_with(in_seconds) && !has_token(tokens, "1000")) // `time.sleep(pause)`
    return offer(best.substr(0, best.size() - in_seconds.size()));
  const bool calls = tokens.size() == 4 && tokens[1].is("(") && tokens[3].is(")"); // `pause(20)`
  if (!(calls || tokens.size() == 2) || best.find('\n') != std::string::npos)
    return Next::GoOn;
  const auto& value = tokens[calls ? 2 : tokens.size() - 1];
  const auto number = value.is_number() ? parse_number<int>(value.text).value_or(0) : 0;
  if (number < few)
    return Next::GoOn;
  const auto written = " " + value.text;
  if (tokens[0].is("wait") && number % half_second == 0 && number <= most_ticks &&
      trial.line().language() != Language::Macro && best.ends_with(written)) { // sixtieths, in Logo
    const auto ms = number / half_second * 500;
    return offer(best.substr(0, best.size() - value.text.size()) +
                 (trial.line().language() == Language::Basic ? std::to_string(ms) : time_text(ms)));
  }
  if (best.ends_with(written + "000"))
    return offer(best.substr(0, best.size() - 3));
  if (best.ends_with(written + "s"))
    return offer(best.substr(0, best.size() - 1) + "ms");
  return Next::GoOn;
}

/// The condition for a step.
enum class When : std::uint8_t {
  NothingFound, ///< no line yet
  Unsettled,    ///< or a line that still has another finding
  Always,
};

struct Step {
  std::string_view origin; ///< its name in --explain-repairs
  std::uint8_t languages;  ///< a bit for each Language
  When when;
  Next (*propose)(Trial&);
};

using in::all;
using in::basic;
using in::macro;
using in::programs;
using in::structured;
using in::test;

// clang-format off
constexpr auto steps = std::to_array<Step>({
    {"forgotten command", macro,      When::NothingFound, forgotten_command},
    {"line number",       basic,      When::NothingFound, split_number},
    {"block",             macro,      When::NothingFound, bare_end},
    {"block",             structured, When::NothingFound, misspelt_end},
    {"title",             test,       When::NothingFound, test_title},
    {"one by one",        programs,   When::NothingFound, one_by_one},
    {"order of values",   all,        When::NothingFound, other_order},
    {"quotes",            programs,   When::NothingFound, one_quote},
    {"bracket",           all,        When::Always,       one_bracket},
    {"own sub",           all,        When::Always,       own_call},
    {"own sub",           structured, When::NothingFound, own_sub},
    {"own sub",           all,        When::NothingFound, missing_value},
    {"fix",               all,        When::NothingFound, by_fix_of_name},
    {"notation",          all,        When::NothingFound, as_read},
    {"letters",           all,        When::NothingFound, by_letters},
    {"row",               all,        When::Unsettled,    by_rows},
    {"fix",               all,        When::Unsettled,    by_fix},
    {"word left out",     all,        When::NothingFound, words_left_out},
    {"sentence",          programs,   When::NothingFound, by_gist},
    {"changes",           all,        When::NothingFound, by_all_changes},
    {"quotes",            programs,   When::NothingFound, text_unquoted},
    {"words too many",    all,        When::NothingFound, among_unknown},
    {"unit too many",     programs | test, When::NothingFound, without_unit},
    {"unit too many",     programs | test, When::NothingFound, without_units},
    {"quantity too many", all,        When::NothingFound, without_quantity},
    {"milliseconds",      all,        When::Always,       in_milliseconds},
});
// clang-format on

bool is_due(const Step& step, const Trial& trial) {
  switch (step.when) {
  case When::NothingFound: return !trial.found();
  case When::Unsettled: return !trial.settled();
  case When::Always: break;
  }
  return true;
}

} // namespace

std::vector<Accepted> mend(Trial& trial) {
  if (trial.line().tokens.size() > most_tokens)
    return {};
  const auto language = in::bit(trial.line().language());
  for (const auto& step : steps) {
    if ((step.languages & language) == 0 || !is_due(step, trial))
      continue;
    trial.begin(step.origin);
    if (step.propose(trial) == Next::Enough)
      break;
  }
  return trial.offers();
}

} // namespace orb::repair
