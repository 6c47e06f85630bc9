#include "testing/meant.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "testing/lookup.h"
#include "testing/text/rules.h"
#include "testing/texts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

namespace orb::testing {
namespace {

namespace basic = compiler;

// ---- output

/// A part of a printed line.
struct PrintedPart {
  enum class Kind : std::uint8_t { Text, Number, Character };
  Kind kind = Kind::Text;
  std::string text; ///< for Text
};
using Printed = std::vector<PrintedPart>;

/// The lines that a program can print, one for each `print`. Nothing if one line comes from several
/// `print`s or contains numbers computed from line numbers.
std::optional<std::vector<Printed>> printed_lines(const basic::Program& program) {
  std::vector<Printed> lines;
  for (const auto& statement : program.statements) {
    if (statement.error || statement.kind == spec::Statement::Tron)
      return std::nullopt;
    if (statement.kind != spec::Statement::Print)
      continue;
    const auto items = program.items_of(statement);
    if (!items.empty() && items.back().kind == basic::ItemKind::Semicolon)
      return std::nullopt;
    auto& line = lines.emplace_back();
    const auto add_text = [&](std::string_view text) {
      if (line.empty() || line.back().kind != PrintedPart::Kind::Text)
        line.emplace_back();
      line.back().text += text;
    };
    for (const auto& item : items) {
      const auto quoted = program.text_of(item.span);
      if (item.kind == basic::ItemKind::String)
        add_text(quoted.substr(1, quoted.size() - 2));
      else if (item.kind == basic::ItemKind::Comma)
        add_text(" ");
      else if (item.kind == basic::ItemKind::Character)
        line.push_back({PrintedPart::Kind::Character, {}});
      else if (item.kind == basic::ItemKind::Expression)
        line.push_back({PrintedPart::Kind::Number, {}});
    }
  }
  return lines;
}

/// Pieces and characters left at points where the search has already failed.
using DeadEnds = std::set<std::pair<std::size_t, std::size_t>>;

/// Returns how a printed line can equal `text`, spelled as the program prints it; `equal` compares
/// letters. Nothing if it cannot.
template <typename Equal>
std::optional<std::string> as_printed(std::span<const PrintedPart> line, std::string_view text,
                                      const Equal& equal, DeadEnds& dead) {
  if (line.empty())
    return text.empty() ? std::optional(std::string()) : std::nullopt;
  if (!dead.insert({line.size(), text.size()}).second)
    return std::nullopt; // this search failed before
  const auto with = [&](std::string_view printed, std::size_t taken) {
    auto rest = as_printed(line.subspan(1), text.substr(taken), equal, dead);
    if (rest)
      rest->insert(0, printed);
    return rest;
  };
  const auto& first = line.front();
  if (first.kind == PrintedPart::Kind::Text)
    return equal(text.substr(0, first.text.size()), first.text)
               ? with(first.text, first.text.size())
               : std::nullopt;
  if (first.kind == PrintedPart::Kind::Character)
    return text.empty() ? std::nullopt : with(text.substr(0, 1), 1);
  for (std::size_t end = text.starts_with('-') ? 1 : 0; end < text.size() && is_digit(text[end]);
       ++end)
    if (auto rest = with(text.substr(0, end + 1), end + 1))
      return rest;
  return std::nullopt;
}

bool is_character(const PrintedPart& piece) {
  return piece.kind == PrintedPart::Kind::Character;
}

/// Removes blanks at both ends.
Printed trimmed(Printed line) {
  const auto is_text = [](const PrintedPart& piece) {
    return piece.kind == PrintedPart::Kind::Text;
  };
  if (!line.empty() && is_text(line.front()))
    line.front().text.erase(0, line.front().text.find_first_not_of(' '));
  if (!line.empty() && is_text(line.back()))
    line.back().text.resize(line.back().text.find_last_not_of(' ') + 1);
  return line;
}

/// Returns what the program prints in place of an expected line that it never prints. Nothing if it
/// may print the line, or prints nothing like it.
std::optional<std::string> printed_like(std::string_view text, const std::vector<Printed>& lines) {
  const auto is_printed = [&](const Printed& line) {
    DeadEnds dead;
    return as_printed(std::span(line), text, std::equal_to<>(), dead).has_value();
  };
  if (std::any_of(lines.begin(), lines.end(), is_printed))
    return std::nullopt;
  for (const auto& line : lines) {
    if (std::any_of(line.begin(), line.end(), is_character))
      continue;
    const auto bare = trimmed(line);
    DeadEnds dead;
    auto found = as_printed(std::span(bare), trim(text), equal_words, dead);
    if (!found || found->empty())
      continue;
    const auto blanks = [](const PrintedPart& piece, std::size_t most) {
      return piece.kind == PrintedPart::Kind::Text
                 ? std::string(std::min(piece.text.size(), most), ' ')
                 : std::string();
    };
    const auto before = line.front().text.find_first_not_of(' ');
    const auto after = line.back().text.find_last_not_of(' ');
    return blanks(line.front(), before) + *found +
           blanks(line.back(), line.back().text.size() - after - 1);
  }
  return std::nullopt;
}

/// The same for a part of a line. The part has no digits, as digits could come from any number.
std::optional<std::string> printed_like_part(std::string_view text,
                                             const std::vector<Printed>& lines) {
  const auto part = trim(text);
  std::optional<std::string> like;
  for (const auto& line : lines)
    for (const auto& piece : line) {
      if (piece.kind == PrintedPart::Kind::Character || piece.text.find(text) != std::string::npos)
        return std::nullopt;
      const auto found = std::search(piece.text.begin(), piece.text.end(), part.begin(), part.end(),
                                     [](char a, char b) { return to_lower(a) == to_lower(b); });
      if (found != piece.text.end() && !like)
        like.emplace(found, found + static_cast<std::ptrdiff_t>(part.size()));
    }
  return part.empty() || std::any_of(text.begin(), text.end(), is_digit) ? std::nullopt : like;
}

// ---- driving

/// The headings along which a program rolls, ascending. Nothing if they are not all numbers, or if
/// the ball may move in another way.
std::optional<std::vector<int>> headings_of(const basic::Program& program) {
  std::set<int> headings;
  const auto number = [&](const basic::Item& item) -> std::optional<std::int32_t> {
    const auto& node = program.nodes[item.value];
    return node.kind == basic::NodeKind::Number ? std::optional(node.value) : std::nullopt;
  };
  for (const auto& statement : program.statements) {
    const auto kind = statement.kind;
    if (statement.error || kind == spec::Statement::Raw || kind == spec::Statement::Heading ||
        kind == spec::Statement::Locate || kind == spec::Statement::Macrun)
      return std::nullopt;
    if (kind != spec::Statement::Goroll)
      continue;
    const auto items = program.items_of(statement);
    if (number(items[1]) == 0)
      continue; // brakes
    const auto heading = number(items[0]);
    if (!heading || *heading < 0 || *heading >= spec::ball::full_circle)
      return std::nullopt;
    headings.insert(*heading);
  }
  return headings.empty() ? std::nullopt
                          : std::optional(std::vector<int>(headings.begin(), headings.end()));
}

/// The sector between the headings of a program. A program that switches between them can reach any
/// place in it.
class Sector {
public:
  /// Returns nothing if the headings are so far apart that a turn may lead anywhere.
  static std::optional<Sector> of(const std::vector<int>& headings) {
    constexpr int narrow = 135; // degrees; a ball turning to an opposite heading drives a curve
    for (std::size_t i = 0; i < headings.size(); ++i) {
      const auto last = headings[(i + headings.size() - 1) % headings.size()];
      const auto wide = (last - headings[i] + spec::ball::full_circle) % spec::ball::full_circle;
      if (wide <= narrow)
        return Sector(headings[i], wide);
    }
    return std::nullopt;
  }

  /// Degrees between a place's direction and the sector.
  double off(double x, double y) const {
    const double circle = spec::ball::full_circle;
    const auto half = std::numbers::pi;
    const double direction = std::atan2(x, y) / half * (circle / 2);
    const double from_first = std::fmod(direction - first_ + 2 * circle, circle);
    return from_first <= wide_ ? 0 : std::min(from_first - wide_, circle - from_first);
  }

private:
  Sector(int first, int wide) : first_(first), wide_(wide) {}

  double first_;
  double wide_;
};

class Meant {
public:
  Meant(SuiteFile& file, const Prepared& program)
      : file_(file), source_(*file.source), name_(program.name) {}

  void check_prints(const basic::Program& program) {
    const auto lines = printed_lines(program);
    if (!lines)
      return;
    for (const auto& test : file_.file.tests)
      for (const auto& whole : test.expectations)
        for (const auto* one : parts_of(whole)) {
          if (one->never || one->times.least == 0)
            continue;
          if (one->word == Word::Print && one->match != Match::Pattern)
            told_as(whole.span, one->text,
                    one->match == Match::Whole ? printed_like(one->text, *lines)
                                               : printed_like_part(one->text, *lines));
          if (one->word == Word::Prints)
            check_listed(*one, *lines);
        }
  }

  /// If one place is out of reach with its coordinates in either order, the program is unfinished:
  /// stays silent then.
  void check_places(const basic::Program& program) {
    const auto headings = headings_of(program);
    const auto sector = headings ? Sector::of(*headings) : std::nullopt;
    if (!sector || file_.file.course)
      return;
    std::vector<const Expectation*> exchanged;
    for (const auto& test : file_.file.tests) {
      if (std::any_of(test.stimuli.begin(), test.stimuli.end(), &may_move))
        continue;
      for (const auto& whole : test.expectations)
        for (const auto* one : parts_of(whole)) {
          if (one->never || !is_off(*one, *sector))
            continue;
          if (!fits_exchanged(*one, *sector))
            return;
          if (one == &whole)
            exchanged.push_back(one);
        }
    }
    for (const auto* one : exchanged)
      told_exchanged(*one, *headings);
  }

private:
  /// True if a stimulus of the test can move the ball.
  static bool may_move(const vm::TimedStimulus& event) {
    using namespace vm::stimulus;
    return !std::holds_alternative<Number>(event.stimulus) &&
           !std::holds_alternative<ClientColor>(event.stimulus) &&
           !std::holds_alternative<Connect>(event.stimulus) &&
           !std::holds_alternative<Disconnect>(event.stimulus);
  }

  void told_as(Span line, const std::string& text, const std::optional<std::string>& printed) {
    if (!printed)
      return;
    offer(finding(rules::OtherLetters, line, texts::PrintsInOtherLetters(name_, *printed)),
          '"' + text + '"', '"' + *printed + '"', texts::WriteOrPrint);
  }

  /// Checks the lines below `expect prints`.
  void check_listed(const Expectation& one, const std::vector<Printed>& lines) {
    auto line = one.line;
    for (const auto& text : one.texts) {
      do
        ++line;
      while (line < source_.line_count() && !trim(source_.line(line)).starts_with('"'));
      const auto all = source_.line(line);
      const auto begin = source_.line_start(line) +
                         static_cast<std::uint32_t>(std::min(all.find('"'), all.size()));
      told_as({begin, source_.line_span(line).end}, text, printed_like(text, lines));
    }
  }

  static constexpr double quarter = spec::ball::full_circle / 4.0;

  /// Distance in cm from a place to the nearest one that the program can reach.
  static double apart(double x, double y, const Sector& sector) {
    const auto angle = sector.off(x, y);
    const auto away = std::hypot(x, y);
    return angle < quarter ? away * std::sin(angle / quarter * std::numbers::pi / 2) : away;
  }

  static bool is_off(const Expectation& one, const Sector& sector) {
    constexpr double least = 30; // degrees
    constexpr double curve = 40; // cm a ball may drift while it turns to its heading
    if (one.word == Word::Near && !one.other_ball)
      return sector.off(one.x, one.y) >= least && apart(one.x, one.y, sector) >= one.by + curve;
    if (one.word != Word::Beyond)
      return false;
    const auto [x, y] = ahead(one);
    return sector.off(x, y) >= quarter && (x + y) * one.most >= curve;
  }

  static bool fits_exchanged(const Expectation& one, const Sector& sector) {
    if (one.word == Word::Near)
      return apart(one.y, one.x, sector) <= one.by;
    const auto [x, y] = ahead(one);
    return sector.off(y, x) == 0;
  }

  /// The direction of `beyond`: one of the two is 0.
  static std::pair<int, int> ahead(const Expectation& beyond) {
    switch (beyond.side) {
    case Side::AboveX: return {1, 0};
    case Side::BelowX: return {-1, 0};
    case Side::AboveY: return {0, 1};
    case Side::BelowY: break;
    }
    return {0, -1};
  }

  void told_exchanged(const Expectation& one, const std::vector<int>& headings) {
    const auto written = std::string(source_.text(one.span));
    std::string words;
    std::string others;
    if (one.word == Word::Near) {
      const auto comma = written.find(',');
      const auto begin = written.find_last_of(" \t", comma) + 1;
      const auto end =
          std::min(written.find(' ', written.find_first_not_of(' ', comma + 1)), written.size());
      words = written.substr(begin, end - begin);
      others =
          fmt::format("{},{}", trim(std::string_view(written).substr(comma + 1, end - comma - 1)),
                      written.substr(begin, comma - begin));
    } else {
      const auto sign = written.find_first_of("<>");
      const auto axis = written.find_last_of("xy", sign);
      words = written.substr(axis, sign + 1 - axis);
      others = words;
      others.front() = words.front() == 'x' ? 'y' : 'x';
    }
    offer(finding(rules::OffTheWay, one.span,
                  texts::NeverDrivesThere(name_, fmt::format("{}", fmt::join(headings, ", ")))),
          words, others, texts::WriteOrTurn);
  }

  /// Adds a finding that offers the line with some of its words replaced.
  void offer(Diagnostic d, const std::string& words, const std::string& others,
             const Row<Hole::Code>& help) {
    auto written = std::string(source_.text(d.span));
    if (const auto at = written.find(words); at != std::string::npos) {
      written.replace(at, words.size(), others);
      d.help = help(written);
      d.fix = single_fix(texts::Write(written), d.span, written, Safety::Unsafe);
    }
    file_.file.diagnostics.push_back(std::move(d));
  }

  SuiteFile& file_;
  const Source& source_;
  const std::string& name_;
};

} // namespace

void check_meant(SuiteFile& file, const Prepared& program) {
  const auto* const first = run::first_with_program(program.inputs);
  if (!program.problem.empty() || first == nullptr || !file.file.balls.empty())
    return;
  Meant meant(file, program);
  meant.check_prints(first->program->parsed);
  meant.check_places(first->program->parsed);
  sort_by_place(file.file.diagnostics);
}

} // namespace orb::testing
