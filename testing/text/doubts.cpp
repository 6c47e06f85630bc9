#include "testing/text/doubts.h"

#include "base/cursor.h"
#include "base/duration.h"
#include "base/fixes.h"
#include "base/text/text.h"
#include "repair/tokens.h"
#include "report/texts.h"
#include "spec/ball.h"
#include "testing/text/rules.h"
#include "testing/text/texts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace orb::testing {
namespace {

using Of = When::Kind;

class Doubts {
public:
  Doubts(const Source& source, const TestFile& file) : source_(source), file_(file) {}

  std::vector<Diagnostic> run() {
    for (const auto& test : file_.tests) {
      for (const auto& one : test.expectations) {
        if (one.line == 0)
          continue;
        check_bound(test, one);
        check_start(one);
        check_moving(test, one);
        check_contradiction(test, one);
      }
    }
    check_stimuli();
    check_walls();
    return std::move(found_);
  }

private:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {}) {
    found_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return found_.back();
  }

  std::string text_of(const Expectation& one) const { return std::string(source_.text(one.span)); }

  /// Offers the line as it should be written.
  static void write(Diagnostic& d, const Expectation& one, const std::string& line) {
    d.help = file_texts::Write(line);
    d.fix = single_fix(d.help, one.span, line, Safety::Unsafe);
  }

  /// The whole seconds of run time that a moment needs.
  static std::int64_t seconds_for(Duration time) { return (time + 999ms) / Duration{1s}; }

  void check_bound(const Test& test, const Expectation& one) {
    const auto kind = one.when.kind;
    if ((kind == Of::Within || kind == Of::At || kind == Of::During) && one.when.to > test.bound)
      too_late(rules::Bound, one.span, test, one.when.to);
  }

  void too_late(const Rule& rule, Span span, const Test& test, Duration time) {
    const auto line = fmt::format("for {}s", seconds_for(time));
    auto& d = report(rule, span, file_texts::EndsBefore(), file_texts::WriteForLonger(line));
    if (source_.line(test.line).find(" for ") != std::string_view::npos)
      return; // set by this test itself
    for (std::uint32_t n = 1; n <= source_.line_count(); ++n) {
      Cursor cursor(source_, n);
      const auto begin = cursor.offset();
      const auto word = cursor.word();
      if (word == info(LineWord::For).word) {
        cursor.word();
        d.fix = single_fix(file_texts::Write(line), cursor.span_from(begin), line, Safety::Unsafe);
        return;
      }
      if (word == info(LineWord::Test).word || n == source_.line_count()) {
        const auto at = source_.line_start(word == info(LineWord::Test).word ? n : 1);
        d.fix = single_fix(file_texts::Write(line), {at, at},
                           line + std::string(line_end_of(source_.text())), Safety::Unsafe);
        return;
      }
    }
  }

  /// The ball starts at 0,0 unless a line says otherwise.
  void check_start(const Expectation& one) {
    if (one.word != Word::Near || one.other_ball || file_.course || !file_.balls.empty() ||
        !one.joined.empty() || one.order != Order::Free || one.lasts > Duration{} ||
        one.when.kind != Of::AnyTime ||
        std::hypot(one.x, one.y) > (one.never ? one.by : 0)) // another place implies driving
      return;
    auto& d =
        report(rules::Start, one.span,
               one.never ? file_texts::StartsThereFails() : file_texts::StartsThereSucceeds());
    write(d, one, text_of(one) + " at end");
  }

  void check_moving(const Test& test, const Expectation& one) {
    if (one.word != Word::Moving || one.never || one.when.kind != Of::AtEnd ||
        !one.joined.empty() || one.lasts > Duration{})
      return;
    const auto rests = std::any_of(
        test.expectations.begin(), test.expectations.end(), [](const Expectation& other) {
          const bool place =
              other.word == Word::Near || other.word == Word::Inside || other.word == Word::Resting;
          return !other.never &&
                 (other.word == Word::End || (place && other.when.kind == Of::AtEnd));
        });
    if (!rests)
      return;
    auto line = text_of(one);
    const std::string_view moving = info(Word::Moving).word;
    line.replace(line.find(moving), moving.size(), info(Word::Resting).word);
    write(report(rules::MovingAtEnd, one.span, file_texts::RestsAtEnd()), one, line);
  }

  std::string what_of(const Expectation& one) const {
    auto what = repair::tokens_of(text_of(one), repair::Language::Test);
    for (std::size_t i = 1; i < what.size(); ++i) {
      const bool counts = what[i].is_number() && i + 1 < what.size() &&
                          (what[i + 1].is("times") || what[i + 1].is("to"));
      if (counts || what[i].is("within") || what[i].is("at") || what[i].is("during"))
        what.resize(i);
    }
    return repair::join(repair::slice(what, 1));
  }

  /// True if `never` covers all times at which the other one is expected.
  static bool covers(const When& never, const When& expected) {
    if (never.kind == Of::AnyTime)
      return true;
    if (never.kind != Of::During)
      return false;
    switch (expected.kind) {
    case Of::Within: return never.from == Duration{} && never.to >= expected.to;
    case Of::At: return never.from <= expected.to && never.to >= expected.to;
    case Of::During: return never.from <= expected.to && never.to >= expected.from;
    case Of::AnyTime:
    case Of::AtEnd: return false;
    }
    return false;
  }

  void check_contradiction(const Test& test, const Expectation& one) {
    if (one.never || one.order != Order::Free || !one.joined.empty() || one.lasts > Duration{} ||
        one.times.least == 0)
      return;
    for (const auto& other : test.expectations) {
      if (!other.never || other.line == 0 || other.word != one.word || other.ball != one.ball ||
          !other.joined.empty() || other.order != Order::Free || other.lasts > Duration{} ||
          !covers(other.when, one.when) || what_of(other).empty() || what_of(other) != what_of(one))
        continue;
      report(rules::Contradiction, one.span, file_texts::NeverMet(), file_texts::ChangeOneTime())
          .notes.push_back({other.span, file_texts::ForbiddenHere()});
      return;
    }
  }

  /// Returns the test that contains a line; the first one for lines above it.
  const Test* test_of(std::uint32_t line) const {
    const Test* found = nullptr;
    for (const auto& test : file_.tests)
      if (found == nullptr || test.line <= line)
        found = &test;
    return found;
  }

  void check_stimuli() {
    for (std::uint32_t n = 1; n <= source_.line_count(); ++n) {
      Cursor cursor(source_, n);
      const auto begin = cursor.offset();
      if (!cursor.take_word("at"))
        continue;
      const auto time = parse_duration(cursor.word());
      const auto* test = test_of(n);
      cursor.take_rest();
      if (time && test != nullptr && *time >= test->bound)
        report(rules::Bound, cursor.span_from(begin), file_texts::EndsBefore(),
               file_texts::LaterAfterWord(info(LineWord::For).word));
    }
  }

  /// Reports a wall at the ball's place, before anything has moved.
  void check_walls() {
    if (!file_.balls.empty())
      return; // each ball has a start
    for (std::uint32_t n = 1; n <= source_.line_count(); ++n) {
      Cursor cursor(source_, n);
      const auto begin = cursor.offset();
      if (!cursor.take_word("wall"))
        continue;
      cursor.take_rest();
      vm::StimulusScript script;
      vm::read_stimulus_line(source_, n, script);
      for (const auto& event : script.events)
        if (const auto* wall = std::get_if<vm::Wall>(&event.stimulus);
            wall != nullptr && wall->axis != vm::Wall::Axis::None &&
            std::abs(wall->at_cm) < spec::ball::radius)
          report(rules::WallAtStart, cursor.span_from(begin),
                 report::texts::WallIsNear(fmt::format("{}", spec::ball::radius)),
                 file_texts::MoveWall());
    }
  }

  const Source& source_;
  const TestFile& file_;
  std::vector<Diagnostic> found_;
};

} // namespace

std::vector<Diagnostic> find_doubts(const Source& source, const TestFile& file) {
  return Doubts(source, file).run();
}

} // namespace orb::testing
