#include "testing/text/foreign.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/idioms.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace orb::testing {
namespace {

using repair::append;
using repair::close_of;
using repair::Token;
using repair::Tokens;
using repair::word;

/// What is tested, as test files call it.
std::string_view subject_of(std::string_view written) {
  struct Subject {
    std::string_view word;
    std::string_view words;
  };
  constexpr auto subjects = std::to_array<Subject>({
      {"print", "print prints printed output console log stdout text message result"},
      {"near", "position pos location place robot ball sphero near"},
      {"color", "color colour led light leds"},
      {"distance", "distance path"},
      {"end", "duration runtime program"},
  });
  for (const auto& subject : subjects)
    if (holds(subject.words, written))
      return subject.word;
  return written;
}

/// A number without a unit as a time: few are seconds, many milliseconds.
Tokens timed(Tokens values) {
  constexpr int most_seconds = 200;
  if (values.size() == 1 && values[0].is_text())
    values = repair::tokens_of(values[0].text, repair::Language::Test);
  if (values.size() != 1 || !values[0].is_number())
    return values;
  const auto number = parse_number<double>(values[0].text, std::chars_format::fixed).value_or(0);
  const auto ms = std::lround(number <= most_seconds ? number * 1000 : number);
  return repair::tokens_of(time_text(ms), repair::Language::Test);
}

/// The words of a call of the chain, put behind those before it.
class Chain {
public:
  /// False where a call says nothing that is known.
  bool add(std::string_view method, Tokens values) {
    if (holds("not never", method))
      never_ = true;
    else if (holds("to be and it should have been that with resolves eventually", method) &&
             values.empty())
      ;
    else if (holds("toBeLessThan toBeBelow lessThan below toBeLessThanOrEqual", method))
      append_with("<", values);
    else if (holds("toBeGreaterThan toBeAbove greaterThan above toBeGreaterThanOrEqual", method))
      append_with(">", values);
    else if (holds("toHaveBeenCalledTimes times toBeCalledTimes toHaveBeenPrintedTimes", method) &&
             values.size() == 1)
      append(tail_, {word(values[0].text), word("times")});
    else if (holds("between toBeBetween", method) && values.size() > 2) {
      for (auto& token : values)
        if (token.is(","))
          token.text = "..";
      for (auto& token : values)
        token.gap = false;
      values[0].gap = true;
      append(values_, values);
    } else if (holds("within toBeWithin before under in withinTime timeout toHappenWithin", method))
      within(values);
    else if (holds("atEnd atTheEnd finally", method) && values.empty())
      append(tail_, {word("at"), word("end")});
    else if (holds("at after", method) && !values.empty()) {
      tail_.push_back(word("at"));
      append(tail_, values[0].is("end") || (values[0].is_text() && values[0].text == "end")
                        ? Tokens{word("end")}
                        : timed(values));
    } else if (holds("by tolerance closeTo", method) && !values.empty()) {
      tail_.push_back(word("by"));
      append(tail_, plain(values));
    } else if (method.starts_with("to") ||
               holds("equals equal is contains contain matches match near", method))
      equals(method, std::move(values));
    else
      return false;
    return true;
  }

  void set_subject(Tokens subject) {
    if (subject.size() > 3 && subject[1].is("(") && subject.back().is(")")) { // `near(37, 37)`
      values_ = repair::slice(subject, 2, subject.size() - 1);
      subject.resize(1);
    }
    subject_ = subject.empty() ? std::string() : std::string(subject_of(subject.back().text));
  }

  Tokens words() const {
    Tokens all{word(never_ ? "never" : "expect")};
    const bool axis = subject_ == "x" || subject_ == "y";
    if (reach_)
      all = {word(never_ ? "never" : "reach")};
    else if (axis)
      all.push_back(word("beyond"));
    append(all, repair::tokens_of(subject_, repair::Language::Test));
    all.back().gap = true;
    append(all, values_);
    append(all, tail_);
    return all;
  }

private:
  /// Quoted values are values; only what is printed keeps its quotes.
  Tokens plain(const Tokens& values) const {
    Tokens all;
    for (auto token : values)
      if (token.is_text() && subject_ != "print")
        append(all, repair::tokens_of(token.text, repair::Language::Test));
      else if (!token.is("{") && !token.is("}"))
        all.push_back(token);
    if (!all.empty())
      all[0].gap = true;
    return all;
  }

  void append_with(std::string_view relation, const Tokens& values) {
    if (subject_ == "end") {
      within(values);
      return;
    }
    values_.push_back(Token{Token::Kind::Sign, std::string(relation)});
    append(values_, plain(values));
  }

  void within(const Tokens& values) {
    const auto said = plain(values);
    const bool length = said.size() == 2 && holds("cm m mm", said[1].text);
    tail_.push_back(word(length ? "by" : "within"));
    append(tail_, length ? said : timed(said));
  }

  void equals(std::string_view method, Tokens values) {
    if (const auto brace = std::find_if(values.begin(), values.end(),
                                        [](const Token& token) { return token.is("{"); });
        brace != values.end()) { // `{ within: 10000 }`
      const Tokens options(brace + 1, values.end());
      values.erase(brace, values.end());
      if (options.size() > 2 && options[1].is(":"))
        add(options[0].text,
            repair::slice(options, 2, options.size() - (options.back().is("}") ? 1 : 0)));
    }
    while (!values.empty() && values.back().is(","))
      values.pop_back();
    if (values.size() == 1 && (values[0].is("true") || values[0].is("false"))) {
      never_ = never_ != values[0].is("false");
      return;
    }
    reach_ = holds("toBeReached toReach toHaveReached", method);
    const auto comma = std::find_if(values.begin(), values.end(),
                                    [](const Token& token) { return token.is(","); });
    const bool second = comma != values.end() &&
                        (subject_ == "color" || subject_ == "heading" || subject_ == "print");
    if (second) { // how near
      const Tokens tolerance(comma + 1, values.end());
      values.erase(comma, values.end());
      if (subject_ != "print")
        add("by", tolerance);
    }
    const bool part =
        never_ && subject_ == "print" && holds("toContain contain contains toInclude", method);
    if (part && values.size() == 1 && values[0].is_text())
      values_.push_back(Token{Token::Kind::Sign, "~", true});
    auto said = plain(values);
    if (part && !said.empty())
      said[0].gap = false;
    append(values_, said);
  }

  std::string subject_;
  Tokens values_;
  Tokens tail_; ///< by, times, when
  bool never_ = false;
  bool reach_ = false;
};

/// `at(500, () => roll(0, 160))`
Tokens timed_callback(const Tokens& line) {
  Tokens all{word("at")};
  append(all, timed({line[2]}));
  for (std::size_t at = 4; at < line.size(); ++at)
    if (line[at].is_word() || line[at].is_number() || line[at].is("-") || line[at].is(","))
      all.push_back(line[at]);
  return all;
}

/// `at(8000).shake()`
Tokens timed_event(const Tokens& line) {
  const auto close = close_of(line, 1);
  if (line.size() > 6 && line[2].is_number() && line[3].is(",") && line[4].is("("))
    return timed_callback(line);
  if (close + 2 >= line.size() || !line[close + 1].is("."))
    return {};
  Tokens all{word("at")};
  append(all, timed(repair::slice(line, 2, close)));
  for (auto at = close + 2; at < line.size(); ++at)
    if (!line[at].is("(") && !line[at].is(")") && !line[at].is(";"))
      all.push_back(line[at]);
  return all;
}

} // namespace

namespace {

/// `assert robot.inside("garage") at end`, `robot.roll(0, 160) at 500ms`
Tokens words_of_method(const Tokens& line) {
  const std::size_t from = holds("assert expect", line[0].text) ? 1 : 0;
  if (line.size() < from + 4 || !holds("robot ball sphero bot", line[from].text) ||
      !line[from + 1].is("."))
    return {};
  Tokens all;
  if (from == 1)
    all.push_back(word("expect"));
  const bool prints = holds("print prints printed", line[from + 2].text);
  for (auto at = from + 2; at < line.size(); ++at)
    if (line[at].is_text() && !prints)
      append(all, repair::tokens_of(line[at].text, repair::Language::Test));
    else if (!line[at].is("(") && !line[at].is(")") && !line[at].is(";"))
      all.push_back(line[at]);
  for (auto& token : all)
    token.gap = true;
  return all;
}

} // namespace

Tokens words_of_chain(const Tokens& line) {
  if (auto method = line.size() > 4 ? words_of_method(line) : Tokens(); !method.empty())
    return method;
  if (line.size() < 4 || !line[0].is_word() || !line[1].is("("))
    return {};
  if (equal_words(line[0].text, "at"))
    return timed_event(line);
  if (equal_words(line[0].text, "setTimeout")) { // `setTimeout(() => spin(0), 7500)`
    const auto close = close_of(line, 1);
    if (close < 6 || close >= line.size() || !line[close - 1].is_number() ||
        !line[close - 2].is(","))
      return {};
    Tokens all{word("at")};
    append(all, timed({line[close - 1]}));
    for (std::size_t at = 2; at + 2 < close; ++at)
      if (line[at].is_word() || line[at].is_number() || line[at].is("-") || line[at].is(","))
        all.push_back(line[at]);
    return all;
  }
  if (!holds("expect assert assertThat verify should", line[0].text))
    return {};
  Chain chain;
  auto at = close_of(line, 1);
  if (at + 1 >= line.size() || !line[at + 1].is("."))
    return {};
  chain.set_subject(repair::slice(line, 2, at));
  for (++at; at + 1 < line.size() && line[at].is(".");) {
    const auto& method = line[at + 1].text;
    at += 2;
    Tokens values;
    if (at < line.size() && line[at].is("(")) {
      const auto close = close_of(line, at);
      values = repair::slice(line, at + 1, close);
      at = std::min(close + 1, line.size());
    }
    if (!chain.add(method, values))
      return {};
  }
  auto all = chain.words();
  for (; at < line.size(); ++at) // `… within 5s`
    if (!line[at].is(";") && !line[at].is(","))
      all.push_back(line[at]);
  return all;
}

Tokens without_signs(const Tokens& line) {
  if (std::any_of(line.begin(), line.end(), [](const Token& token) { return token.is("/"); }))
    return line; // a pattern
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto& token = line[i];
    const bool names = token.is(":") && i > 0 && line[i - 1].is_word();
    const bool axis = names && (line[i - 1].is("x") || line[i - 1].is("y"));
    const bool item = i == 0 && token.is("-") && line.size() > 1 && line[1].is_word();
    const bool ends = token.is(",") && i + 2 < line.size() && line[i + 1].is_word() &&
                      line[i + 2].is(":"); // of `color: blue, by: 10`
    if (ends)
      continue;
    if (axis) {
      all.push_back(Token{Token::Kind::Sign, "="});
      continue;
    }
    if (token.is("!") && i + 1 < line.size() && line[i + 1].is_word() && !line[i + 1].gap) {
      all.push_back(word("not"));
      continue;
    }
    if (names || item || token.is("[") || token.is("]") || token.is("{") || token.is("}"))
      continue;
    all.push_back(token);
  }
  return all;
}

Tokens plain_places(const Tokens& line) {
  Tokens all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    auto token = line[i];
    const bool axis = !all.empty() && (all.back().is("x") || all.back().is("y"));
    if (axis && (token.is(">>") || token.is("<<")))
      token.text.resize(1);
    const auto sign = all.empty() || !all.back().is("-") ? all.size() : all.size() - 1;
    const bool place =
        sign > 1 && all[sign - 1].is_relation() && (all[sign - 2].is("x") || all[sign - 2].is("y"));
    const auto* const unit = place && token.is_number() && i + 1 < line.size() && !line[i + 1].gap
                                 ? repair::unit_called(line[i + 1].text, Measure::Length)
                                 : nullptr;
    if (unit != nullptr) {
      const auto value = parse_number<double>(token.text, std::chars_format::fixed).value_or(0);
      token.text = fmt::format("{}", value * unit->in(unit::cm));
      ++i;
    }
    all.push_back(token);
  }
  return all;
}

Tokens with_units(const Tokens& line) {
  constexpr std::array written{unit::m, unit::cm, unit::s, unit::ms};
  auto all = line;
  for (std::size_t i = 1; i < all.size(); ++i)
    for (const auto measure : {Measure::Time, Measure::Length})
      if (const auto* const unit = all[i].is_word() && all[i - 1].is_number()
                                       ? repair::unit_called(all[i].text, measure)
                                       : nullptr;
          unit != nullptr && find_unit(unit->word, written) != nullptr) {
        all[i].text = unit->word;
        all[i].gap = false;
      }
  return all;
}

Tokens with_spans(const Tokens& line) {
  const auto unit = [&](std::size_t at) {
    return at + 1 < line.size() && line[at].is_number() &&
           (line[at + 1].is("s") || line[at + 1].is("ms") || line[at + 1].is("min"));
  };
  for (std::size_t i = 0; i + 5 < line.size(); ++i) {
    const bool span = line[i].is("between") && line[i + 3].is("..");
    const bool between_ = span || (line[i].is("between") && line[i + 3].is("and"));
    const bool from = holds("from von de desde da", line[i].text) &&
                      (line[i + 3].is("to") || line[i + 3].is("until") || line[i + 3].is("till"));
    if (!(between_ || from) || !unit(i + 1) || !unit(i + 4))
      continue;
    auto all = repair::slice(line, 0, i);
    all.push_back(word("during"));
    append(all, repair::slice(line, i + 1, i + 3));
    all.push_back(Token{Token::Kind::Sign, ".."});
    append(all, repair::slice(line, i + 4));
    all[i + 4].gap = false;
    return all;
  }
  return line;
}

Tokens with_times(Tokens line) {
  if (line.size() > 5 && holds("on when", line[0].text) && equal_words(line[1].text, "timer")) {
    std::erase_if(
        line, [](const Token& token) { return token.is("(") || token.is(")") || token.is("="); });
    line.erase(line.begin());
    line[0].text = "at";
    if (line.size() > 2 && line[1].is_number() && !(line[2].is_word() && !line[2].gap))
      line.insert(line.begin() + 2, Token{Token::Kind::Word, "s"});
    line[1].gap = true;
  }
  for (std::size_t i = 0; i + 3 < line.size(); ++i)
    if (line[i].is("(") && line[i + 1].is("ms") && line[i + 2].is(")") && line[i + 3].is_number()) {
      line[i] = line[i + 3];
      line[i].gap = true;
      line[i + 1].gap = false;
      line.erase(line.begin() + static_cast<std::ptrdiff_t>(i) + 2,
                 line.begin() + static_cast<std::ptrdiff_t>(i) + 4);
    }
  return line;
}

std::string line_of_file(const Tokens& line) {
  constexpr auto ends = std::to_array<std::string_view>({".bas", ".orb", ".macro", ".svg"});
  std::string name;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i].is("=") || line[i].is(";") || line[i].is(":") || line[i].is("<") || line[i].is(">"))
      continue;
    if (!name.empty() && line[i].gap)
      return {}; // more than a name
    name += line[i].text;
  }
  for (const auto end : {";", ">"})
    if (name.ends_with(end))
      name.pop_back();
  const auto ending = std::find_if(ends.begin(), ends.end(),
                                   [&](std::string_view one) { return name.ends_with(one); });
  if (ending == ends.end() || !line[0].is_word() ||
      name.find_first_of(" ()\"") != std::string::npos)
    return {};
  const bool course = *ending == ".svg";
  const bool known =
      line[0].is("with") || line[0].is("program") || line[0].is("course") || line[0].is("target");
  const bool runs = holds("run load start execute use open esegui starte ejecuta ejecutar exécute "
                          "executa lade carica import",
                          line[0].text);
  const bool places = holds("backdrop background map stage bühne fondo fond sfondo", line[0].text);
  if (!known && !(course ? places : runs))
    return {};
  return fmt::format("{} {}", known ? line[0].text : course ? "course" : "program", name);
}

Tokens without_points(Tokens line) {
  if (line.size() < 4 || !(line[0].is("expect") || line[0].is("never") || line[0].is("wall")) ||
      !line[1].is("."))
    return line;
  std::erase_if(line, [](const Token& token) {
    return token.is(".") || token.is("(") || token.is(")") || token.is(";");
  });
  for (auto& token : line)
    token.gap = true;
  return line;
}

} // namespace orb::testing
