#include "testing/text/rephrase.h"

#include "base/duration.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/units.h"
#include "spec/ball.h"
#include "testing/text/foreign.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

namespace orb::testing {
namespace {

using repair::Counts;
using repair::Language;
using repair::Operand;
using repair::Quantity;
using repair::Rephrased;
using repair::Token;
using repair::Tokens;

constexpr auto whole = Quantity::one;
constexpr std::int64_t full_circle = spec::ball::full_circle;

const ExpectationInfo* expectation(const Token& token) {
  const auto found =
      std::find_if(expectations.begin(), expectations.end(), [&](const ExpectationInfo& row) {
        return token.is_word() && row.word == token.text && &row != &info(Word::Variable);
      });
  return found == expectations.end() ? nullptr : &*found;
}

bool is_time_unit(const Token& token) {
  return token.is_word() && find_unit(token.text, time_units) != nullptr;
}

/// What a line says, in phrases; each as it was written.
struct Phrases {
  Tokens what;  ///< the word of what is expected, then its values
  Tokens by;    ///< without `by`
  Tokens times; ///< with `times`
  Tokens when;  ///< with its word
};

/// Reads phrases from left to right.
class Reader {
public:
  explicit Reader(const Tokens& line) : line_(line) {}

  std::optional<Phrases> read(std::size_t from) {
    for (at_ = from; at_ < line_.size();) {
      if (phrase(phrases_.when,
                 {time_end("within"), moment_end(), span_end(), later_end(), time_end("until")}) ||
          phrase(phrases_.times, {times_end()}))
        continue;
      if (line_[at_].is("by") && number_end(at_ + 1) > at_ + 1) {
        if (!phrases_.by.empty())
          return std::nullopt;
        const auto end = number_end(at_ + 1);
        phrases_.by = repair::slice(line_, at_ + 1, end);
        at_ = end;
        continue;
      }
      if (is_time(at_) && at_ + 2 == line_.size() && !phrases_.what.empty() &&
          phrases_.when.empty()) {
        phrases_.when =
            repair::slice(line_, at_, at_ + 2); // which of `at` and `within` is not said
        at_ += 2;
        continue;
      }
      if (line_[at_].is("end") && at_ + 1 == line_.size() && !phrases_.what.empty() &&
          phrases_.when.empty()) {
        phrases_.when = {Token{Token::Kind::Word, "at", true}, line_[at_++]};
        phrases_.when[1].gap = true;
        continue;
      }
      for (const auto& row : join_words)
        if (line_[at_].is(row.word) || line_[at_].is("then"))
          return std::nullopt; // two are expected
      phrases_.what.push_back(line_[at_++]);
    }
    return std::move(phrases_);
  }

private:
  bool phrase(Tokens& into, std::initializer_list<std::size_t> ends) {
    for (const auto end : ends)
      if (end > at_ && into.empty()) {
        into = repair::slice(line_, at_, end);
        at_ = end;
        return true;
      }
    return false;
  }

  /// Where a number with its unit ends that begins at `at`.
  std::size_t number_end(std::size_t at) const {
    if (at >= line_.size() || !line_[at].is_number())
      return at;
    const bool unit = at + 1 < line_.size() && line_[at + 1].is_word() && !line_[at + 1].gap;
    return at + (unit ? 2 : 1);
  }
  bool is_time(std::size_t at) const {
    return number_end(at) == at + 2 && is_time_unit(line_[at + 1]);
  }

  std::size_t time_end(std::string_view word) const {
    return line_[at_].is(word) && is_time(at_ + 1) ? at_ + 3 : at_;
  }
  std::size_t moment_end() const {
    const bool end = line_[at_].is("at") && at_ + 1 < line_.size() && line_[at_ + 1].is("end");
    return end ? at_ + 2 : time_end("at");
  }
  std::size_t span_end() const {
    if (!line_[at_].is("during"))
      return at_;
    const auto dots = number_end(at_ + 1);
    return dots < line_.size() && line_[dots].is("..") && is_time(dots + 1) ? dots + 3 : at_;
  }
  /// `after 5s`, where nothing else follows.
  std::size_t later_end() const {
    const auto end = time_end("after");
    return end == line_.size() ? end : at_;
  }
  std::size_t times_end() const {
    auto at = at_;
    if (!line_[at].is_number())
      return at_;
    ++at;
    if (at + 1 < line_.size() && line_[at].is("to") && line_[at + 1].is_number())
      at += 2;
    return at < line_.size() && line_[at].is("times") ? at + 1 : at_;
  }

  const Tokens& line_;
  std::size_t at_ = 0;
  Phrases phrases_;
};

/// `A..B` and `A to B` with the smaller value first.
Tokens ascending(Tokens tokens) {
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].is("..") && !tokens[i].is("to"))
      continue;
    auto begin = i;
    if (begin > 1 && tokens[begin - 1].is_word() && !tokens[begin - 1].gap)
      --begin;
    if (begin > 0 && tokens[begin - 1].is_number())
      --begin;
    auto end = i + 1;
    if (end < tokens.size() && tokens[end].is_number())
      ++end;
    if (end < tokens.size() && tokens[end].is_word() && !tokens[end].gap)
      ++end;
    auto left = repair::slice(tokens, begin, i);
    auto right = repair::slice(tokens, i + 1, end);
    if (left.empty() || right.empty() || !left[0].is_number() || !right[0].is_number())
      continue;
    const auto factor = [](const Tokens& value) {
      const auto word = value.size() > 1 ? std::string_view(value[1].text) : std::string_view();
      const auto* const time = find_unit(word, time_units);
      const auto* const unit = time != nullptr ? time : find_unit(word, length_units);
      return unit != nullptr ? static_cast<double>(unit->steps) : 1.0;
    };
    const auto value = [&](const Tokens& of) {
      const bool bare = of.size() == 1; // it has the unit of the other
      return parse_number<double>(of[0].text, std::chars_format::fixed).value_or(0) *
             factor(bare ? (left.size() > 1 ? left : right) : of);
    };
    if (value(left) <= value(right))
      continue;
    if (left.size() > 1 && right.size() == 1)
      right.push_back(left[1]); // `110cm..90`
    else if (left.size() == 1 && right.size() > 1)
      left.push_back(right[1]); // `110..90cm`
    std::swap(left[0].gap, right[0].gap);
    Tokens all = repair::slice(tokens, 0, begin);
    all.insert(all.end(), right.begin(), right.end());
    all.push_back(tokens[i]);
    all.insert(all.end(), left.begin(), left.end());
    all.insert(all.end(), tokens.begin() + static_cast<std::ptrdiff_t>(end), tokens.end());
    return all;
  }
  return tokens;
}

/// A place and how far from it: what has a unit is the distance.
std::optional<std::string> near(const Tokens& values, const Tokens& by, const std::string& usual) {
  std::vector<std::string> numbers;
  std::string distance = repair::join(by);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& token = values[i];
    if (token.is(",") || token.is(";") || token.is("(") || token.is(")") || token.is("[") ||
        token.is("]") || token.is("=") || token.is(":") || token.is("x") || token.is("y") ||
        token.is("by") || token.is("at") || token.is("<") || token.is("<=") ||
        token.is("within")) // a length is no time
      continue;
    const bool sign = token.is("-") && i + 1 < values.size() && values[i + 1].is_number();
    if (!token.is_number() && !sign)
      return std::nullopt;
    const auto number = (sign ? "-" : "") + values[i + (sign ? 1 : 0)].text;
    i += sign ? 1 : 0;
    const bool unit =
        i + 1 < values.size() && find_unit(values[i + 1].text, length_units) != nullptr;
    const bool is_place = unit && !distance.empty() && !values[i + 1].is("mm");
    i += unit ? 1 : 0;
    if (unit && distance.empty())
      distance = number + values[i].text;
    else if (is_place && values[i].is("m"))
      numbers.push_back(
          fmt::format("{}", parse_number<double>(number, std::chars_format::fixed).value_or(0) *
                                unit::m.in(unit::cm)));
    else if (!unit || is_place)
      numbers.push_back(number);
    else
      return std::nullopt;
  }
  if (const auto point = numbers.empty() ? std::string::npos : numbers[0].find('.');
      numbers.size() == 1 && point != std::string::npos) { // `near 90.90`
    numbers.push_back(numbers[0].substr(point + 1));
    numbers[0].resize(point);
  }
  const auto part_of_metre = [](const std::string& number) {
    return number.find("0.") != std::string::npos;
  };
  if (distance.ends_with("m") && part_of_metre(distance) && distance.find('c') == std::string::npos)
    distance.pop_back(); // places in metres, too
  const bool metres = std::all_of(numbers.begin(), numbers.end(), [&](const std::string& number) {
    return part_of_metre(number) || number == "0" || number == "1.0";
  });
  const bool parts =
      std::any_of(numbers.begin(), numbers.end(), part_of_metre) || part_of_metre(distance);
  if (numbers.size() >= 2 && distance.find_first_of("cm") == std::string::npos && metres && parts &&
      (distance.empty() || part_of_metre(distance))) { // `near 0.37,0.37 by 0.08`
    const auto in_cm = [](std::string& number) {
      number = fmt::format(
          "{}", std::round(parse_number<double>(number, std::chars_format::fixed).value_or(0) *
                           unit::m.in(unit::cm)));
    };
    std::for_each(numbers.begin(), numbers.end(), in_cm);
    if (!distance.empty())
      in_cm(distance);
  }
  if (numbers.size() == 3 && distance.empty()) { // `near 90 90 15`
    distance = numbers[2] + "cm";
    numbers.pop_back();
  }
  if (distance.empty())
    distance = usual;
  if (numbers.size() != 2 || distance.empty())
    return std::nullopt;
  if (is_digit(distance.back()))
    distance += "cm";
  return fmt::format("near {},{} by {}", numbers[0], numbers[1], distance);
}

/// A line that is not to be crossed: `x -90`, `(x < -90)`; which side is told by the sign.
std::optional<std::string> beyond(const Tokens& values) {
  std::string axis;
  std::string relation;
  std::string number;
  for (const auto& token : values) {
    if (axis.empty() && token.is_word() && holds("x xcor xpos y ycor ypos", token.text))
      axis = token.text.substr(0, 1);
    else if ((token.is("<") || token.is(">")) && relation.empty())
      relation = token.text;
    else if (token.is("-") && number.empty())
      number = "-";
    else if (token.is_number() && number.size() < 2)
      number += token.text;
    else if (!token.is("(") && !token.is(")") && !token.is("=") && !token.is("cm") &&
             !token.is(",") && !token.is(";"))
      return std::nullopt;
  }
  if (axis.empty() || number.empty() || number == "-")
    return std::nullopt;
  if (relation.empty())
    relation = number[0] == '-' ? "<" : ">";
  return fmt::format("beyond {}{}{}", axis, relation, number);
}

/// An angle from 0 to 359.
std::optional<std::string> heading(const Tokens& values) {
  const auto value = repair::quantity_of(values, {});
  if (!value || value->thousandths % whole != 0 ||
      (value->measure != Measure::Number && value->measure != Measure::Angle))
    return std::nullopt;
  return fmt::format("heading {}",
                     (value->thousandths / whole % full_circle + full_circle) % full_circle);
}

/// When an expectation of that kind can say that it is; empty for no time at all.
std::string when_of(const ExpectationInfo& row, const Tokens& when, bool never, Duration bound) {
  const auto text = repair::join(when);
  if (when.empty())
    return row.word == info(Word::End).word ? text : std::string();
  if (when[0].is("after")) {
    const auto time = repair::join(repair::slice(when, 1));
    return row.kind == Kind::Event
               ? fmt::format("during {}..{}s", time, (bound + 999ms) / Duration{1s})
           : row.kind == Kind::State && !never ? "at " + time
                                               : text;
  }
  const bool at_end = when.size() == 2;
  const bool moment = when[0].is("at") && !at_end;
  const auto time = repair::join(repair::slice(when, 1));
  switch (row.kind) {
  case Kind::State:
  case Kind::Stay: return never && when[0].is("within") ? "during 0s.." + time : text;
  case Kind::Event:
    if (never && (moment || when[0].is("within")))
      return "during 0s.." + time;
    return at_end ? std::string() : moment ? "within " + time : text;
  case Kind::End: {
    const auto dots = time.find("..");
    return at_end ? text : "within " + (dots == std::string::npos ? time : time.substr(dots + 2));
  }
  case Kind::Output: return {};
  case Kind::Final: return at_end ? text : std::string();
  }
  return text;
}

/// Several texts are the lines that are printed, one below the other; one is the first of them
/// where others stand below.
std::optional<std::string> texts(const Tokens& what, const Elsewhere& elsewhere) {
  std::string all;
  std::size_t count = 0;
  for (std::size_t i = 1; i < what.size(); ++i) {
    if (what[i].is(","))
      continue;
    if (!what[i].is_text())
      return std::nullopt;
    all += fmt::format("\n\"{}\"", what[i].text);
    ++count;
  }
  const bool first = count == 1 && what[0].is("prints") && elsewhere.has_texts;
  return count > 1 || first ? std::optional("expect prints" + all) : std::nullopt;
}

/// About a tenth more and less than one length: `1m` is `90cm..110cm`.
std::string around(const Tokens& values) {
  const auto text = repair::join(values);
  if (values.size() != 2 || !values[0].is_number())
    return text;
  const auto value = parse_number<double>(values[0].text, std::chars_format::fixed).value_or(0);
  const auto* const unit = repair::unit_called(values[1].text, Measure::Length);
  if (unit == nullptr)
    return text;
  constexpr double tenth = 0.1;
  const auto cm = value * unit->in(unit::cm);
  return fmt::format("{}cm..{}cm", std::lround(cm * (1 - tenth)), std::lround(cm * (1 + tenth)));
}

/// What is expected, with its values; empty where no word says what.
struct What {
  const ExpectationInfo* row = nullptr;
  std::string text;
  bool never = false;
  bool sure = true;
};

/// A number before or after what happens is how often.
void count_events(const ExpectationInfo& row, Tokens& values, Tokens& times) {
  if (row.kind != Kind::Event || !times.empty() || values.empty() || !values[0].is_number())
    return;
  const bool alone = values.size() == 1 && row.word == info(Word::Collision).word;
  const bool before_text = values.size() == 2 && values[1].is_text();
  if (!alone && !before_text)
    return;
  times = {values[0], Token{Token::Kind::Word, "times", true}};
  values.erase(values.begin());
}

What what_of(Phrases& phrases, bool never, const Elsewhere& elsewhere) {
  auto& what = phrases.what;
  What all;
  all.never = never;
  const auto negations = std::erase_if(what, [](const Token& token) {
    return token.is_word() && (token.is("not") || token.is("no") || token.is("nicht") ||
                               token.is("never") || token.is("isnt"));
  });
  all.never = never || negations > 0;
  const auto word = std::find_if(what.begin(), what.end(),
                                 [](const Token& token) { return expectation(token) != nullptr; });
  if (word == what.end() && what.size() == 1 && repair::test_colour(what[0])) {
    all.row = &info(Word::Color);
    all.text = fmt::format("{} {}", all.row->word, *repair::test_colour(what[0]));
    return all;
  }
  if (what.size() == 2 && what[0].is("~") && what[1].is_text()) {
    all.row = &info(Word::Print);
    all.text = fmt::format("{} {}", all.row->word, repair::join(what));
    return all;
  }
  const auto numbers =
      std::count_if(what.begin(), what.end(), [](const Token& token) { return token.is_number(); });
  if (word == what.end() && numbers == 2 && !phrases.by.empty())
    if (const auto place = near(what, phrases.by, {})) {
      phrases.by.clear();
      all.row = &info(Word::Near);
      all.text = *place;
      return all;
    }
  if (word == what.end())
    return all;
  all.row = expectation(*word);
  const auto& row = *all.row;
  const bool print = row.word == info(Word::Print).word;
  if (print &&
      std::any_of(word + 1, what.end(), [](const Token& token) { return token.is("/"); })) {
    all.row = nullptr;
    return all;
  }
  std::rotate(what.begin(), word, word + 1);
  auto values = ascending(repair::slice(what, 1));
  if (!values.empty() && values[0].is("=")) // `getHeading() = 180`
    values.erase(values.begin());
  count_events(row, values, phrases.times);
  all.text = std::string(row.word);
  if (row.word == info(Word::Near).word) {
    if (const auto place = near(values, phrases.by, elsewhere.near_by)) {
      all.text = *place;
      all.sure = near(values, phrases.by, {}).has_value();
      phrases.by.clear();
      return all;
    }
  } else if (row.word == info(Word::Beyond).word) {
    if (const auto line = beyond(values)) {
      all.text = *line;
      values.clear();
    }
  } else if (row.word == info(Word::Heading).word) {
    if (const auto angle = heading(values)) {
      all.text = *angle;
      values.clear();
      if (phrases.by.empty() && !elsewhere.heading_by.empty()) {
        all.text += " by " + elsewhere.heading_by;
        all.sure = false;
      }
    }
  } else if (row.word == info(Word::Color).word && values.size() == 1) {
    if (values[0].is("0"))
      values[0] = Token{Token::Kind::Word, "off", true};
    if (const auto colour = repair::test_colour(values[0]))
      values[0] = Token{Token::Kind::Word, *colour, true};
  } else if (row.word == info(Word::Distance).word) {
    if (!values.empty() && values[0].is("~"))
      values.erase(values.begin());
    const auto range = around(values);
    all.sure = range == repair::join(values);
    all.text += " " + range;
    return all;
  }
  if (!values.empty())
    all.text += " " + repair::join(values);
  return all;
}

/// Whether a word is nearly one of what can be expected.
bool is_misspelt(std::string_view word) {
  std::vector<std::string_view> words;
  for (const auto& row : expectations)
    words.push_back(row.word);
  return closest(word, words).has_value();
}

std::optional<Rephrased> arrange_expectation(const Tokens& line, bool never,
                                             const Elsewhere& elsewhere) {
  auto phrases = Reader(line).read(0);
  if (!phrases || phrases->what.empty())
    return std::nullopt;
  if (!never && phrases->when.empty() && phrases->times.empty() && phrases->by.empty())
    if (const auto lines = texts(phrases->what, elsewhere);
        lines && (phrases->what[0].is("print") || phrases->what[0].is("prints")))
      return Rephrased{*lines, true};
  // `A = 5` is known at the end.
  const auto& what = phrases->what;
  if (what.size() > 2 && what[0].is_word() && expectation(what[0]) == nullptr && what[1].is("=") &&
      phrases->times.empty())
    return Rephrased{fmt::format("{} {} at end", never ? "never" : "expect", repair::join(what)),
                     true};
  const bool zone = what.size() == 1 && what[0].is_word() && elsewhere.has_course &&
                    !repair::test_colour(what[0]) && expectation(what[0]) == nullptr &&
                    !is_misspelt(what[0].text);
  if (zone)
    phrases->what.insert(phrases->what.begin(),
                         Token{Token::Kind::Word, std::string(info(Word::Inside).word), true});
  const auto said = what_of(*phrases, never, elsewhere);
  if (said.row == nullptr)
    return std::nullopt;
  auto text = (said.never ? "never " : "expect ") + said.text;
  if (!phrases->by.empty())
    text += " by " + repair::join(phrases->by);
  if (!phrases->times.empty() && said.row->kind == Kind::Event)
    text += " " + repair::join(ascending(phrases->times));
  if (!phrases->when.empty() && phrases->when[0].is("until")) {
    const auto time = repair::join(repair::slice(phrases->when, 1));
    const auto all_along = fmt::format("{} during 0s..{}", text, time);
    const auto within = fmt::format("{} within {}", text, time);
    return said.row->kind != Kind::State ? Rephrased{within, true}
           : said.never                  ? Rephrased{all_along, true}
                                         : Rephrased{all_along, false, within};
  }
  if (!phrases->when.empty() && phrases->when[0].is_number()) {
    const auto time = repair::join(phrases->when);
    const auto within = fmt::format("{} within {}", text, time);
    if (said.never)
      return Rephrased{fmt::format("{} during 0s..{}", text, time), false};
    return said.row->kind == Kind::State
               ? Rephrased{fmt::format("{} at {}", text, time), false, within}
               : Rephrased{within, false};
  }
  auto when = when_of(*said.row, ascending(phrases->when), said.never, elsewhere.bound);
  const bool ends = said.row->kind == Kind::End;
  const bool whenever = ends && elsewhere.has_bound && (when.empty() || when == "at end");
  if (whenever)
    when = fmt::format("within {}s", (elsewhere.bound + 999ms) / Duration{1s});
  return Rephrased{text + (when.empty() ? "" : " ") + when, said.sure && !whenever && !zone};
}

/// Two things, one before or after the other, or both at once.
std::optional<Rephrased> arrange_joined(const Tokens& line, bool never,
                                        const Elsewhere& elsewhere) {
  const auto joint = std::find_if(line.begin(), line.end(), [](const Token& token) {
    return token.is("then") || token.is("before") || token.is("after") || token.is("and") ||
           token.is("or");
  });
  if (joint == line.end() || joint == line.begin())
    return std::nullopt;
  const auto at = static_cast<std::size_t>(joint - line.begin());
  auto left = Reader(repair::slice(line, 0, at)).read(0);
  auto right_tokens = repair::slice(line, at + 1);
  auto right = Reader(right_tokens).read(0);
  if (!left || !right || left->what.empty() || right->what.empty())
    return std::nullopt;
  auto first = what_of(*left, never, elsewhere);
  if (first.row == nullptr)
    return std::nullopt;
  never = first.never;
  const bool has_word = std::any_of(right->what.begin(), right->what.end(), [](const Token& token) {
    return expectation(token) != nullptr;
  });
  if (!has_word) // `color red before green`
    right->what.insert(right->what.begin(),
                       Token{Token::Kind::Word, std::string(first.row->word), true});
  const auto second = what_of(*right, never, elsewhere);
  if (second.row == nullptr)
    return std::nullopt;
  const auto with = [](const What& what, const Phrases& phrases) {
    auto text = what.text;
    if (!phrases.by.empty())
      text += " by " + repair::join(phrases.by);
    if (!phrases.times.empty())
      text += " " + repair::join(phrases.times);
    return text;
  };
  // An exact time between the two needs a tolerance.
  if (joint->is("after") && !left->when.empty() && left->when[0].is_number()) {
    const auto by = right->by.empty() ? std::string("200ms") : repair::join(right->by);
    right->by.clear();
    return Rephrased{fmt::format("{} {} {} after {} by {}", never ? "never" : "expect",
                                 with(first, *left), repair::join(left->when), with(second, *right),
                                 by),
                     true};
  }
  auto when = left->when.empty() ? right->when : left->when;
  // Neither of two, or both of two that happen: a line for each.
  const bool each = joint->is("or") ? never : joint->is("and") && second.row->kind == Kind::Event;
  if (joint->is("or") && !each)
    return std::nullopt;
  const auto verb = never ? "never" : "expect";
  if (each) {
    const auto line_of = [&](const What& what, const Phrases& phrases) {
      return fmt::format("{} {}{}{}", verb, with(what, phrases), when.empty() ? "" : " ",
                         repair::join(when));
    };
    return Rephrased{line_of(first, *left) + "\n" + line_of(second, *right), true};
  }
  const auto word = joint->is("then") ? "before" : joint->text;
  if (word == "before")
    when.clear();
  return Rephrased{fmt::format("{} {} {} {}{}{}", verb, with(first, *left), word,
                               with(second, *right), when.empty() ? "" : " ", repair::join(when)),
                   joint->text != "then"};
}

/// An unterminated text ends before the words that say how often or when.
std::optional<Tokens> close_text(const Tokens& line) {
  if (line.empty() || !line.back().is_text() || line.back().closed)
    return std::nullopt;
  const auto& text = line.back().text;
  for (auto blank = text.find(' '); blank != std::string::npos; blank = text.find(' ', blank + 1)) {
    auto rest = repair::tokens_of(std::string_view(text).substr(blank), Language::Test);
    Phrases phrases;
    if (const auto read = Reader(rest).read(0))
      phrases = *read;
    const bool seeds =
        line[0].is("test") && rest.size() > 1 && rest[0].is("seeds") && rest[1].is_number();
    const bool more = rest.size() > 2 && rest[0].is("and") && expectation(rest[1]) != nullptr;
    if (!seeds && !more &&
        (!phrases.what.empty() || !phrases.by.empty() ||
         (phrases.when.empty() && phrases.times.empty())))
      continue;
    Tokens all = line;
    all.back().text = text.substr(0, blank);
    all.back().closed = true;
    if (!all.back().text.empty() && !rest.empty())
      rest[0].gap = true;
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
  }
  return std::nullopt;
}

/// What a stimulus takes, as its row says.
std::vector<Operand> operands_of(const vm::StimulusInfo& row) {
  std::vector<Operand> operands;
  for (const auto& slot : row.slots) {
    Operand operand;
    operand.name = slot.called->english;
    operand.usual = slot.usual;
    if (slot.kind == slot::Kind::Choice) {
      operand.words = {"on", "off"};
      operand.usual = "on";
    } else if (slot.kind == slot::Kind::Time) {
      operand.counts = Counts::Milliseconds;
      operand.most = UINT8_MAX;
    } else if (slot.most == full_circle - 1) {
      operand.counts = Counts::Degrees;
      operand.most = slot.most;
      operand.words = {"0", "90", "180", "270"};
    } else if (slot.least == -slot.most) {
      operand.counts = Counts::Degrees;
      operand.least = -full_circle;
      operand.most = UINT8_MAX;
    } else {
      operand.most = slot.most == UINT8_MAX ? slot.most : 0; // else no part of a byte
    }
    operands.push_back(std::move(operand));
  }
  return operands;
}

/// `at TIME EVENT VALUES`, in any order. A direction or a strength that lacks is that of the
/// example.
std::optional<Rephrased> arrange_stimulus(const Tokens& line) {
  const auto* row = static_cast<const vm::StimulusInfo*>(nullptr);
  for (const auto& token : line)
    for (const auto& each : vm::stimulus_words)
      if (row == nullptr && token.is_word() && token.text == each.word)
        row = &each;
  if (row == nullptr || row->word == "wall")
    return std::nullopt;
  std::string head;
  Tokens values;
  bool left = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i].is(row->word))
      continue;
    if (row->word == "spin" && line[i].is_word() &&
        (repair::is_called("270", line[i].text) || repair::is_called("90", line[i].text))) {
      left = left || repair::is_called("270", line[i].text);
      continue;
    }
    const bool axis = i > 0 && (line[i - 1].is("x") || line[i - 1].is("y"));
    if ((row->word == "spin" && line[i].is("by")) || line[i].is("set") || line[i].is("to") ||
        line[i].is("send") || line[i].is(":") || (line[i].is(",") && i == 3) ||
        (line[i].is("=") && !axis))
      continue;
    if (i + 2 < line.size() && line[i].is("at") && line[i + 1].is_number() &&
        is_time_unit(line[i + 2]) && head.empty()) {
      head = fmt::format("at {}{} ", line[i + 1].text, line[i + 2].text);
      i += 2;
    } else if (i + 1 < line.size() && line[i].is("/") && line[i + 1].is("s")) {
      ++i; // degrees a second
    } else if (i > 1 && line[i - 1].is("=") && (line[i - 2].is("x") || line[i - 2].is("y"))) {
      values.push_back(line[i]);
      values.back().gap = true;
    } else if (i + 1 < line.size() && (line[i].is("x") || line[i].is("y")) && line[i + 1].is("=")) {
      ++i; // `tilt x=-8 y=-12`
    } else {
      values.push_back(line[i]);
    }
  }
  head += row->word;
  for (auto& value : values)
    if (left && value.is_number())
      value.text.insert(0, "-");
  auto operands = operands_of(*row);
  const bool aims = operands.size() == 2 && operands[0].name == "heading";
  if (aims) {
    const auto usual = row->example.substr(row->example.find(row->word) + row->word.size() + 1);
    const auto between = usual.find(' ');
    operands[0].usual = usual.substr(0, between);
    operands[1].usual = usual.substr(between + 1);
    const auto value = values.size() == 1 && values[0].is_number()
                           ? parse_number<int>(values[0].text).value_or(0)
                           : 0;
    if (value > UINT8_MAX)
      return Rephrased{fmt::format("{} {} {}", head, value, usual.substr(between + 1)), false};
    if (value > 0)
      return Rephrased{fmt::format("{} {} {}", head, usual.substr(0, between), values[0].text),
                       false,
                       fmt::format("{} {} {}", head, values[0].text, usual.substr(between + 1))};
  }
  const auto arranged = repair::arrange(values, operands, {});
  if (!arranged || !arranged->wait.empty()) {
    std::string plain; // `battery(6.4);`
    for (const auto& value : values)
      if (!value.is("(") && !value.is(")") && !value.is(";"))
        plain += " " + value.text;
    return values.empty() || !values[0].is("(") ? std::nullopt
                                                : std::optional(Rephrased{head + plain, false});
  }
  for (const auto& value : arranged->values) {
    auto text = value;
    if (const auto unit = text.find("deg"); unit != std::string::npos)
      text.erase(unit);
    constexpr std::size_t few = 3; // digits of a time in seconds
    if (row->word == "toss" && is_digit(text.back()))
      text += text.size() < few ? "s" : "ms";
    head += " " + text;
  }
  return Rephrased{head, arranged->sure};
}

} // namespace

std::string what_is_expected(const Tokens& line) {
  const auto phrases = Reader(line).read(1);
  return phrases ? repair::join(phrases->what) + " " + repair::join(phrases->by) : std::string();
}

namespace {

bool is_vocabulary(std::string_view word, bool first) {
  const auto in = [&](const auto& rows) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.word == word; });
  };
  if (first)
    return in(line_words) || in(vm::stimulus_words) || word == "at";
  return in(expectations) || in(when_words) || in(join_words) || in(vm::stimulus_words) ||
         word == "by" || word == "times" || word == "to" || word == "points" || word == "end" ||
         word == "on" || word == "off" || word == "then" || word == "until" || word == "expect" ||
         word == "never" || word == "seeds" || word == "between";
}

/// How often a word says that something happens: `three` before `times`, `dreimal`; 0 for others.
int counted(const Tokens& line, std::size_t at) {
  const auto& token = line[at];
  if (!token.is_word())
    return 0;
  constexpr std::string_view suffix = "mal";
  if (token.text.size() > suffix.size() && token.text.ends_with(suffix)) {
    auto bare = token;
    bare.text.resize(bare.text.size() - suffix.size());
    return repair::count_of(bare);
  }
  const bool times = at + 1 < line.size() && repair::is_called("times", line[at + 1].text);
  return times ? repair::count_of(token) : 0;
}

/// A line in the words of test files, as far as it is in those of another language.
Tokens translate(const Tokens& line) {
  Tokens all;
  bool in_pattern = false; // between slashes
  for (std::size_t i = 0; i < line.size(); ++i) {
    auto token = line[i];
    if (token.is_word() && is_vocabulary(lower(token.text), all.empty()))
      token.text = lower(token.text); // `Then`
    const auto add = [&](std::string_view word) {
      token.text = word;
      all.push_back(token);
    };
    const auto* const following = i + 1 < line.size() ? &line[i + 1] : nullptr;
    const bool opens =
        token.is("/") && !all.empty() && (all.back().is("print") || all.back().is("~"));
    if (opens || in_pattern) { // another language
      in_pattern = opens || !token.is("/");
      all.push_back(token);
      continue;
    }
    if (following != nullptr && token.is("and") && following->is("then"))
      continue;
    if (token.is("until") && following != nullptr && expectation(*following) != nullptr) {
      add("before");
      continue;
    }
    if (following != nullptr && token.is("to") && following->is("be")) {
      ++i;
      continue;
    }
    if (token.is("+-")) {
      add("by");
      continue;
    }
    if (!all.empty() && token.is_word() && repair::is_called("program", token.text))
      continue; // what ends, prints and drives

    const bool counts = i > 0 && line[i - 1].is_number(); // `3 x`
    const bool axis = (token.is("x") || token.is("y")) && !counts && following != nullptr &&
                      (following->is_number() || following->is("-") || following->is("beyond"));
    const bool of_wall = (token.is("x") || token.is("y")) && !all.empty() &&
                         (all[0].is("wall") || all.back().is("beyond"));
    const bool signed_ =
        axis || of_wall ||
        (following != nullptr && (following->is("=") || following->is(">") || following->is("<")));
    const bool unit = i > 0 && line[i - 1].is_number() &&
                      (!token.gap || repair::is_called("degrees", token.text) ||
                       repair::is_called("turns", token.text));
    if (const auto count = counted(line, i); count > 0) {
      all.push_back(Token{Token::Kind::Number, std::to_string(count), true});
      if (repair::count_of(token) == 0) // `dreimal`
        all.push_back(Token{Token::Kind::Word, "times", true});
      continue;
    }
    const bool asked = (token.text.starts_with("get") || lower(token.text).starts_with("read")) &&
                       repair::parts_of(token.text).size() > 1;
    const bool counted_ = repair::is_called("lines", token.text); // `líneas < 2000`
    if (!token.is_word() || unit || (signed_ && !asked && !counted_) ||
        is_vocabulary(token.text, all.empty()) || expectation(token) != nullptr) {
      all.push_back(token);
      continue;
    }
    if (const auto colour = repair::test_colour(token); colour && !all.empty()) {
      if (all.back().is("and") || all.back().is("before")) // `and green`
        all.push_back(Token{Token::Kind::Word, "color", true});
      add(*colour);
      continue;
    }
    auto next = i + 1; // without the articles after a preposition
    while (next < line.size() && line[next].is_word() && repair::is_called("", line[next].text) &&
           !is_vocabulary(line[next].text, false))
      ++next;
    const bool number = next < line.size() && line[next].is_number();
    const bool timed = number && next + 1 < line.size() && is_time_unit(line[next + 1]);
    const bool long_ = number && !timed && next + 1 < line.size() && !line[next + 1].gap &&
                       line[next + 1].is_word();
    const bool ends =
        next < line.size() && (line[next].is("end") || repair::is_called("end", line[next].text));
    const auto called = [&](std::string_view name) { return repair::is_called(name, token.text); };
    const bool after_near = !all.empty() && all.back().is("near");
    const bool turns = std::any_of(all.begin(), all.end(), [](const Token& before) {
      return before.is("heading") || before.is("color");
    });
    if (!all.empty() && i > 0 && (line[i - 1].is_number() || !line[i - 1].gap) &&
        holds("a à bis hasta até ate tot fino", token.text) && following != nullptr &&
        following->is_number() && line[i - 1].kind != Token::Kind::Sign) { // `90cm a 110cm`
      add("to");
      continue;
    }
    if (all.empty() && timed && (token.is("after") || called("at"))) { // `after 6s set tilt to 0 0`
      add("at");
      continue;
    }
    const bool zone = following != nullptr && following->is_word() &&
                      !is_vocabulary(following->text, false) && !repair::test_colour(*following) &&
                      !repair::is_called("", following->text);
    if (zone && !all.empty() && holds("touching touches touch", token.text))
      add("inside");
    else if (number && !all.empty() && holds("touching locate position", token.text))
      add("near");
    else if (called("within") && timed)
      add("within");
    else if (called("by") && number && (long_ || turns || !called("at")) && !timed && !after_near)
      add("by");
    else if (called("at") && (ends || (number && (timed || all.empty()))))
      add("at");
    else {
      const auto meaning_of = [&](std::string_view said) -> std::string_view {
        for (const auto name : repair::meanings_of(said))
          if (!name.empty() && name != "at" && name != "by" && name != "within" &&
              is_vocabulary(name, all.empty()))
            return name;
        return {};
      };
      std::string found(meaning_of(token.text));
      if (const auto parts = repair::parts_of(token.text); parts.size() > 1)
        for (const auto& part : parts) // `getHeading`, `isMoving`
          if (found.empty() && part != "on")
            found = is_vocabulary(part, all.empty()) ? part : meaning_of(part);
      if (!found.empty())
        add(found);
      else if (!repair::is_called("", token.text) || token.text == "A")
        all.push_back(token);
    }
  }
  return all;
}

/// What is printed, in quotes: `print 25 primes`, `"25" is printed`.
Tokens with_quotes(Tokens all) {
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].is("print") && all[i - 1].is_text())
      std::swap(all[i], all[i - 1]);
  const auto print =
      std::find_if(all.begin(), all.end(), [](const Token& token) { return token.is("print"); });
  const auto begin = print == all.end() ? print : print + 1;
  if (begin == all.end() || begin->is_text() || !(begin->is_word() || begin->is_number()))
    return all;
  const bool signs = begin + 1 != all.end() && (begin + 1)->is("("); // `F(12) = 144`
  const auto end = std::find_if(begin, all.end(), [&](const Token& token) {
    if (signs && token.kind == Token::Kind::Sign)
      return false;
    const auto next = &token + 1 == all.data() + all.size() ? nullptr : &token + 1;
    return is_vocabulary(token.text, false) || !(token.is_word() || token.is_number()) ||
           (token.is_number() && next != nullptr && next->is("times"));
  });
  if (end == begin)
    return all;
  const Token text{Token::Kind::Text, repair::join(Tokens(begin, end)), true};
  all.insert(all.erase(begin, end), text);
  return all;
}

/// Without the second of two words that say the same: `stands still`.
Tokens once_each(Tokens all) {
  all.erase(std::unique(all.begin(), all.end(),
                        [](const Token& a, const Token& b) {
                          return a.is_word() && expectation(a) != nullptr &&
                                 (a.text == b.text || (a.is("resting") && b.is("moving")));
                        }),
            all.end());
  return all;
}

/// `8m to 10m` and `between 8m and 10m` of what takes a range.
Tokens with_ranges(Tokens all) {
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool between = all[i - 1].is("between");
    if (!all[i].is_number() || !(between || all[i - 1].is("distance") || all[i - 1].is("speed")))
      continue;
    auto to = i + 1;
    to += to < all.size() && all[to].is_word() && !all[to].gap ? 1 : 0; // its unit
    if (to < all.size() && all[to].is_number() && !between) {           // `distance 3m 5m`
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(to),
                 Token{Token::Kind::Sign, "..", false});
      all[to + 1].gap = false;
      continue;
    }
    const bool goes_on =
        to + 1 < all.size() && all[to + 1].is_number() &&
        (all[to].is("to") || all[to].is("until") || (between && all[to].is("and")));
    if (!goes_on)
      continue;
    all[to] = Token{Token::Kind::Sign, "..", false};
    all[to + 1].gap = false;
    if (to == i + 1 && to + 2 < all.size() && all[to + 2].is_word() && !all[to + 2].gap)
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(to), Token(all[to + 2])); // of both
    if (between)
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(i) - 1);
  }
  return all;
}

/// `wall` with its axis and place in any form; several are several lines.
std::optional<Rephrased> arrange_wall(const Tokens& line) {
  std::string all;
  std::string axis;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i].is("x") || line[i].is("y"))
      axis = line[i].text;
    const bool negative = line[i].is("-");
    i += negative ? 1 : 0;
    if (i >= line.size() || !line[i].is_number())
      continue;
    if (axis.empty())
      return std::nullopt;
    const bool has_unit = i + 1 < line.size() && line[i + 1].is_word();
    const auto* const unit =
        has_unit ? repair::unit_called(line[i + 1].text, Measure::Length) : &unit::cm;
    if (unit == nullptr)
      return std::nullopt;
    const auto cm = parse_number<double>(line[i].text, std::chars_format::fixed).value_or(0) *
                    unit->in(unit::cm) * (negative ? -1 : 1);
    all += fmt::format("{}wall {}={}", all.empty() ? "" : "\n", axis, cm);
    axis.clear();
  }
  return all.empty() ? std::nullopt : std::optional(Rephrased{all, true});
}

/// `for` with one time among words that say nothing.
std::optional<Rephrased> arrange_bound(const Tokens& line) {
  std::optional<std::string> time;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!line[i].is_number())
      continue;
    const bool unit = i + 1 < line.size() && line[i + 1].is_word();
    const auto found = repair::compute(repair::slice(line, i, i + (unit ? 2 : 1)), {});
    if (time || !found || is_digit(found->back()))
      return std::nullopt;
    time = found;
  }
  return time ? std::optional(Rephrased{"for " + *time, true}) : std::nullopt;
}

std::optional<Rephrased> arrange(const Tokens& line, const Elsewhere& elsewhere) {
  if (line.size() < 2)
    return std::nullopt;
  if (line[0].is("seeds") || line[0].is("test"))
    return Rephrased{repair::join(ascending(line)), true};
  if (line[0].is("wall"))
    return arrange_wall(line);
  if (line[0].is("for"))
    return arrange_bound(line);
  const auto verb = std::find_if(line.begin(), line.end(), [](const Token& token) {
    return token.is("expect") || token.is("never");
  });
  auto rest = line;
  const bool never = verb != line.end() && verb->is("never");
  if (verb != line.end())
    rest.erase(rest.begin() + (verb - line.begin()));
  else if (auto stimulus = arrange_stimulus(line))
    return stimulus;
  else if (!line[0].is("at") && !line[0].is("within") && !line[0].is("during") &&
           expectation(line[0]) == nullptr)
    return std::nullopt;
  for (std::size_t i = 2; i + 1 < rest.size(); ++i) // `inside garage color green`
    if (expectation(rest[i]) != nullptr && expectation(rest[i - 2]) != nullptr &&
        rest[i - 1].is_word() && expectation(rest[i - 1]) == nullptr &&
        !is_vocabulary(lower(rest[i - 1].text), false))
      rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(i++), repair::word("and"));
  for (std::size_t i = 1; i + 1 < rest.size(); ++i) // `inside garage, resting`
    if (rest[i].is(",") && expectation(rest[i + 1]) != nullptr)
      rest[i] = Token{Token::Kind::Word, "and", true};
  if (auto one = arrange_expectation(rest, never, elsewhere))
    return one;
  return arrange_joined(rest, never, elsewhere);
}

/// `inside("island")` as `inside island`; only what is printed is a text.
Tokens unwrapped(const Tokens& line) {
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool value = i + 2 < line.size() && (line[i + 1].is_text() || line[i + 1].is_word());
    const bool prints = i > 0 && value && line[i].is("(") && line[i + 1].is_text() &&
                        line[i + 2].is(")") && says_print(line[i - 1]);
    if (prints) {
      all.push_back(line[i + 1]);
      all.back().gap = true;
      i += 2;
      continue;
    }
    const bool call = i > 0 && value && line[i].is("(") && line[i + 2].is(")") &&
                      (expectation(line[i - 1]) != nullptr || line[i - 1].is("reach")) &&
                      !line[i - 1].is("print");
    if (!call) {
      all.push_back(line[i]);
      continue;
    }
    for (auto token : repair::tokens_of(line[i + 1].text, Language::Test)) {
      token.gap = true;
      all.push_back(token);
    }
    i += 2;
  }
  return all;
}

/// `expect "end within 10s`: the quote of Logo before a word of test files, which is no text.
std::optional<Tokens> without_quote(const Tokens& line) {
  if (line.size() < 2 || !line.back().is_text() || line.back().closed ||
      says_print(line[line.size() - 2]) || line[line.size() - 2].is("~") || line[0].is("test"))
    return std::nullopt;
  auto rest = repair::tokens_of(line.back().text, Language::Test);
  if (rest.empty() || !rest[0].is_word() ||
      !(is_vocabulary(rest[0].text, false) || repair::test_colour(rest[0]) || line[0].is("wall")))
    return std::nullopt;
  rest[0].gap = true;
  auto all = repair::slice(line, 0, line.size() - 1);
  repair::append(all, rest);
  return all;
}

/// `expect say`, `expect print([`: what is printed stands below.
std::string prints_below(const Tokens& line, const Elsewhere& elsewhere) {
  if (line.size() < 2 || !elsewhere.has_texts ||
      !(line[0].is("expect") || repair::is_called("expect", line[0].text)))
    return {};
  const auto word = std::find_if(line.begin() + 1, line.end(),
                                 [](const Token& token) { return token.is_word(); });
  const bool says = word != line.end() && (says_print(*word) || word->is("prints") ||
                                           repair::is_called("prints", word->text));
  const bool ends =
      says && std::all_of(word + 1, line.end(), [](const Token& token) {
        return token.kind == Token::Kind::Sign || holds("toEqual toBe equals is using", token.text);
      });
  return ends ? "expect prints" : std::string();
}

} // namespace

std::vector<Rephrased> rephrase(const Tokens& written, const Elsewhere& elsewhere) {
  const auto line = without_points(unwrapped(with_plain_values(written)));
  if (line.empty())
    return {};
  if (line.size() > 1)
    if (const auto file = line_of_file(written); !file.empty()) {
      constexpr std::string_view program = "program ";
      const bool either = file.starts_with(program) && !line[0].is("program");
      return {{file, false, either ? "with " + file.substr(program.size()) : std::string()}};
    }
  if (const auto block = prints_below(line, elsewhere); !block.empty())
    return {{block, false}};
  const bool says = line[0].is_word() && (equal_words("print", line[0].text) ||
                                          repair::is_called("print", line[0].text));
  if (line.size() == 2 && says && line[1].is_text()) {
    const auto text = fmt::format("\"{}\"", line[1].text);
    auto expected = "expect print " + text;
    if (elsewhere.has_texts)
      return {{text, false, std::move(expected)}};
    return {{std::move(expected), false}};
  }
  if (const auto open = without_quote(line)) {
    auto all = rephrase(*open, elsewhere);
    all.push_back({repair::join(*open), false});
    return all;
  }
  if (const auto closed = close_text(line)) {
    auto all = rephrase(*closed, elsewhere);
    all.push_back({repair::join(*closed), true});
    return all;
  }
  if (elsewhere.has_texts && line.size() > 1 && (line[0].is_number() || line[0].is("[")) &&
      std::all_of(line.begin() + 1, line.end(), [](const Token& token) {
        return token.is("]") ||
               ((token.is_word() || token.is_number()) && !is_vocabulary(token.text, false));
      })) { // `4 corners`, `[facing north]`
    auto words = line;
    std::erase_if(words, [](const Token& token) { return token.is("[") || token.is("]"); });
    return {{fmt::format("\"{}\"", repair::join(words)), false}};
  }
  if (elsewhere.has_texts || line.size() == 1 || line[0].is("-"))
    if (const auto& last = line.back(); !last.is_text() || line[0].is("-"))
      if (line.size() == (line[0].is("-") ? 2U : 1U) && (last.is_text() || last.is_number()))
        return {{fmt::format("\"{}\"", last.text), false}}; // whole of those below `prints`
  const auto chain = words_of_chain(line);
  const auto& said = chain.empty() ? without_signs(line) : chain;
  const auto translated = with_ranges(
      with_spans(with_quotes(once_each(translate(plain_places(with_times(with_units(said))))))));
  if (auto one = arrange(translated, elsewhere))
    return {std::move(*one)};
  if (translated.size() > 1 && repair::join(translated) != repair::join(written))
    return {{repair::join(translated), chain.empty()}};
  return {};
}

} // namespace orb::testing
