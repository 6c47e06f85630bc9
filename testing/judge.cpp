#include "testing/judge.h"

#include "base/suggest.h"
#include "base/text.h"
#include "base/utf8.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace orb::testing {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Lines that are kept to find the nearest among; a longer list helps nobody.
constexpr std::size_t most_kept = 50;
constexpr std::size_t longest_quoted = 80;

/// A number without zeros at its end.
std::string plain(double value, int decimals) {
  auto text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.'))
      text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

/// A number with one decimal, or as many as show that it is greater than `bound`.
std::string above(double value, double bound) {
  for (int decimals = 1; decimals < 6; ++decimals) {
    auto text = fmt::format("{:.{}f}", value, decimals);
    if (std::stod(text) > bound || value <= bound)
      return text;
  }
  return fmt::format("{}", value);
}

std::string quote(std::string_view text) {
  const auto shown = to_printable(text.substr(0, longest_quoted));
  return fmt::format("\"{}{}\"", shown, text.size() <= longest_quoted ? "" : "…");
}

std::string color_words(vm::Color color) {
  for (const auto& row : spec::led_colours)
    if (color == vm::Color{row.red, row.green, row.blue})
      return std::string(row.name);
  return fmt::format("#{:02X}{:02X}{:02X}", color.red, color.green, color.blue);
}

double difference(vm::Color a, vm::Color b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

double outside(double value, double least, double most) {
  return std::max({least - value, value - most, 0.0});
}

/// The angle between two headings.
double turn(double from, double to) {
  const double way = std::abs(std::fmod(from - to, double{spec::ball::full_circle}));
  return std::min(way, spec::ball::full_circle - way);
}

/// How far a sighting is from what is expected of it; 0 where it is met.
double off(const Expectation& one, const Meaning& meaning, const Sighting& s) {
  switch (one.word) {
  case Word::Near: return std::max(0.0, std::hypot(s.x - one.x, s.y - one.y) - one.by);
  case Word::Beyond:
    switch (one.side) {
    case Side::AboveX: return s.x > one.most ? 0 : std::max(one.most - s.x, 1e-12);
    case Side::BelowX: return s.x < one.most ? 0 : std::max(s.x - one.most, 1e-12);
    case Side::AboveY: return s.y > one.most ? 0 : std::max(one.most - s.y, 1e-12);
    case Side::BelowY: return s.y < one.most ? 0 : std::max(s.y - one.most, 1e-12);
    }
    return 0;
  case Word::Inside:
  case Word::Stay: return meaning.zone->distance_cm({s.x, s.y});
  case Word::Heading: return std::max(0.0, turn(s.heading, one.most) - one.by);
  case Word::Speed: return outside(s.speed, one.least, one.most);
  case Word::Moving: return s.moving ? 0 : 1;
  case Word::Resting: return s.moving ? 1 + s.speed : 0;
  case Word::Color: {
    double nearest = infinite;
    for (const auto color : one.colors)
      nearest = std::min(nearest, difference(s.color, color));
    return std::max(0.0, nearest - one.by);
  }
  case Word::BackLed: return outside(s.back, one.least, one.most);
  case Word::Asleep: return s.asleep ? 0 : 1;
  case Word::Print:
  case Word::Prints:
  case Word::Distance:
  case Word::Marker:
  case Word::Collision:
  case Word::Error:
  case Word::End:
  case Word::Lines:
  case Word::Bytes:
  case Word::Variable: break;
  }
  return 0;
}

/// A sighting in the words of what is expected of it.
std::string describe(const Expectation& one, const Meaning& meaning, const Sighting& s) {
  switch (one.word) {
  case Word::Near:
    return fmt::format("{} cm from {},{}", above(std::hypot(s.x - one.x, s.y - one.y), one.by),
                       plain(one.x, 2), plain(one.y, 2));
  case Word::Beyond: {
    const bool x = one.side == Side::AboveX || one.side == Side::BelowX;
    return fmt::format("{} {:.1f}", x ? 'x' : 'y', x ? s.x : s.y);
  }
  case Word::Inside:
  case Word::Stay: {
    const double away = meaning.zone->distance_cm({s.x, s.y});
    return away == 0 ? fmt::format("in {}", one.name.text)
                     : fmt::format("{} cm from {}", above(away, 0), one.name.text);
  }
  case Word::Heading: return fmt::format("heading {}", plain(s.heading, 1));
  case Word::Speed: return fmt::format("{:.1f} cm/s", s.speed);
  case Word::Moving:
  case Word::Resting:
    return s.moving ? fmt::format("moving at {:.1f} cm/s", s.speed) : std::string("resting");
  case Word::Color: return color_words(s.color);
  case Word::BackLed: return fmt::format("back LED {}", s.back);
  case Word::Asleep: return s.asleep ? "asleep" : "awake";
  case Word::Print:
  case Word::Prints:
  case Word::Distance:
  case Word::Marker:
  case Word::Collision:
  case Word::Error:
  case Word::End:
  case Word::Lines:
  case Word::Bytes:
  case Word::Variable: break;
  }
  return {};
}

/// Words that are true or not at a moment.
class StateJudge final : public Judge {
public:
  StateJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void see(const Moment& from, Duration to, const Sighting& s) override {
    using Kind = When::Kind;
    if (certain())
      return;
    const auto& when = one_.when;
    switch (when.kind) {
    case Kind::AnyTime: look_for(from, s, never_ends); break;
    case Kind::Within: look_for(from, s, when.to); break;
    case Kind::At:
      if (from.t <= when.to && when.to < to)
        decide_at(Moment{when.to, from.running}, s, fmt::format("at {}", words(when.to)));
      break;
    case Kind::AtEnd:
      if (to == never_ends)
        decide_at(from, s, fmt::format("at the end, {}", words(from.t)));
      break;
    case Kind::During:
      if (from.t <= when.to && to > when.from && to > from.t)
        check_during({std::max(from.t, when.from), from.running}, s);
      if (!certain() && to > when.to)
        meet();
      break;
    }
    if (!certain() && when.kind == Kind::Within && to > when.to)
      conclude();
  }

  void on_end(const Moment&, const Outcome&) override {
    if (!certain())
      conclude();
  }

  static constexpr Duration never_ends = Duration::max();

private:
  /// A moment at which it is true, until `last`.
  void look_for(const Moment& at, const Sighting& s, Duration last) {
    if (at.t > last)
      return;
    const double away = off(one_, meaning_, s);
    if (away == 0) {
      if (one_.never)
        miss(fmt::format("{} at {}", describe(one_, meaning_, s), words(at.t)), at);
      else
        meet();
    } else if (away < nearest_) {
      nearest_ = away;
      best_ = s;
      best_at_ = at;
    }
  }

  void decide_at(const Moment& at, const Sighting& s, std::string_view moment) {
    if ((off(one_, meaning_, s) == 0) != one_.never)
      return meet();
    miss(fmt::format("{} {}", describe(one_, meaning_, s), moment), at);
  }

  void check_during(const Moment& at, const Sighting& s) {
    if ((off(one_, meaning_, s) == 0) == one_.never)
      miss(fmt::format("{} at {}", describe(one_, meaning_, s), words(at.t)), at);
  }

  /// It was true at no moment.
  void conclude() {
    if (one_.never || one_.when.kind == When::Kind::During)
      return meet();
    miss(fmt::format("nearest {} at {}", describe(one_, meaning_, best_), words(best_at_.t)),
         best_at_);
  }

  const Expectation& one_;
  const Meaning& meaning_;
  double nearest_ = infinite;
  Sighting best_;
  Moment best_at_;
};

/// `stay`: in the zone all the time.
class StayJudge final : public Judge {
public:
  StayJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void see(const Moment& from, Duration to, const Sighting& s) override {
    const bool whole = one_.when.kind == When::Kind::AnyTime;
    if (certain() || (!whole && (from.t > one_.when.to || to <= one_.when.from)))
      return;
    if (meaning_.zone->distance_cm({s.x, s.y}) > 0) {
      const Moment at{whole ? from.t : std::max(from.t, one_.when.from), from.running};
      miss(fmt::format("{} at {}", describe(one_, meaning_, s), words(at.t)), at);
    } else if (!whole && to > one_.when.to)
      meet();
  }
  void on_end(const Moment&, const Outcome&) override {
    if (!certain())
      meet();
  }

private:
  const Expectation& one_;
  const Meaning& meaning_;
};

/// Words that happen: counts how often, and keeps what came near.
class EventJudge final : public Judge {
public:
  EventJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void on_print(const Moment& at, const PrintedLine& line) override {
    if (one_.word != Word::Print || certain() || !in_time(at.t))
      return;
    switch (compare(line.text)) {
    case Pattern::Found::Yes: return happen(at, quote(line.text));
    case Pattern::Found::No: return near(at, line.text);
    case Pattern::Found::GaveUp:
      // At once: with the next lines it would be no better, and nobody would wait for it.
      return miss(
          fmt::format("the pattern takes too many steps on {}; write it simpler", quote(line.text)),
          at);
    }
  }

  void on_marker(const Moment& at, const vm::event::Marker& marker) override {
    if (one_.word != Word::Marker || certain() || !in_time(at.t))
      return;
    auto text = fmt::format("marker {} of macro {}", marker.marker, marker.macro);
    if (marker.marker == one_.number && (one_.name.text.empty() || marker.macro == meaning_.macro))
      return happen(at, std::move(text));
    near(at, text);
  }

  void on_bump(const Moment& at, const vm::event::Bump& bump) override {
    if (one_.word != Word::Collision || certain() || !in_time(at.t))
      return;
    happen(at, fmt::format("it ran into the wall {}", vm::to_string(bump.wall)));
  }

  void on_error(const Moment& at, const run::ProgramError& error) override {
    if (one_.word != Word::Error || certain() || !in_time(at.t))
      return;
    std::string text(spec::info(error.code).text);
    if (!one_.error || *one_.error == error.code)
      return happen(at, error.cause.seen.empty() ? text
                                                 : fmt::format("{}: {}", text, error.cause.seen));
    near(at, text);
  }

  void on_time(Duration t) override {
    if (!certain() && one_.when.kind != When::Kind::AnyTime && t > one_.when.to)
      conclude();
  }

  void on_end(const Moment& at, const Outcome& outcome) override {
    if (certain())
      return;
    const auto& aborted = outcome.ending->aborted;
    if (one_.word == Word::Error && !one_.error && !aborted.empty() && in_time(outcome.over))
      happen({outcome.over, at.running}, aborted);
    if (!certain())
      conclude();
  }

private:
  bool in_time(Duration t) const {
    return one_.when.kind == When::Kind::AnyTime || (one_.when.from <= t && t <= one_.when.to);
  }

  Pattern::Found compare(std::string_view line) const {
    const auto told = [](bool yes) { return yes ? Pattern::Found::Yes : Pattern::Found::No; };
    switch (one_.match) {
    case Match::Whole: return told(line == one_.text);
    case Match::Part: return told(line.find(one_.text) != std::string_view::npos);
    case Match::Pattern: break;
    }
    return one_.pattern->search(line);
  }

  void happen(const Moment& at, std::string text) {
    ++count_;
    if (one_.never)
      return miss(fmt::format("{} at {}", text, words(at.t)), at);
    if (listed_.size() < most_listed)
      listed_.push_back(words(at.t));
    last_ = at;
    if (count_ > one_.times.most)
      miss(count_words(), at);
    else if (count_ >= one_.times.least && one_.times.most == UINT64_MAX)
      meet();
  }

  void near(const Moment& at, std::string_view text) {
    if (kept_.size() >= most_kept)
      return;
    const auto known =
        std::any_of(kept_.begin(), kept_.end(), [&](const auto& one) { return one.text == text; });
    if (!known)
      kept_.push_back({std::string(text.substr(0, longest_kept)), at});
  }

  std::string count_words() const {
    auto text = count_ == 1 ? std::string("once: at ") : fmt::format("{} times: at ", count_);
    for (std::size_t i = 0; i < listed_.size(); ++i)
      text += (i == 0 ? "" : ", ") + listed_[i];
    return count_ > listed_.size() ? text + ", …" : text;
  }

  void conclude() {
    if (one_.never || (count_ >= one_.times.least && count_ <= one_.times.most))
      return meet();
    if (count_ > 0)
      return miss(count_words(), last_);
    const Kept* best = nearest();
    if (best == nullptr)
      return miss(nothing() + until());
    const auto what =
        one_.word == Word::Print ? fmt::format("nearest {}", quote(best->text)) : best->text;
    miss(fmt::format("{} at {}", what, words(best->at.t)), best->at);
  }

  /// Up to when it was looked for, where that is not the whole run.
  std::string until() const {
    switch (one_.when.kind) {
    case When::Kind::Within: return fmt::format(" until {}", words(one_.when.to));
    case When::Kind::During:
      return fmt::format(" from {} to {}", words(one_.when.from), words(one_.when.to));
    case When::Kind::AnyTime:
    case When::Kind::At:
    case When::Kind::AtEnd: break;
    }
    return {};
  }

  std::string nothing() const {
    return one_.word == Word::Print       ? "nothing was printed"
           : one_.word == Word::Marker    ? "no marker was passed"
           : one_.word == Word::Collision ? "it ran into nothing"
                                          : "no error happened";
  }

  struct Kept {
    std::string text;
    Moment at;
  };

  /// The line that is most like the expected one; of equals the first.
  const Kept* nearest() const {
    const Kept* best = nullptr;
    std::size_t least = 0;
    for (const auto& one : kept_) {
      const auto distance = edit_distance(one_.text, one.text);
      if (best == nullptr || distance < least) {
        best = &one;
        least = distance;
      }
    }
    return best;
  }

  static constexpr std::size_t most_listed = 6;
  static constexpr std::size_t longest_kept = 200;

  const Expectation& one_;
  const Meaning& meaning_;
  std::uint64_t count_ = 0;
  std::vector<std::string> listed_;
  std::vector<Kept> kept_;
  std::optional<Moment> last_;
};

/// `prints`: exactly these lines, in this order.
class OutputJudge final : public Judge {
public:
  explicit OutputJudge(const Expectation& one) : one_(one) {}

  void on_print(const Moment& at, const PrintedLine& line) override {
    if (certain())
      return;
    const auto& texts = one_.texts;
    if (next_ == texts.size())
      return miss(fmt::format("a line more: {} at {}", quote(line.text), words(at.t)), at);
    if (line.text != texts[next_])
      return miss(fmt::format("line {} is {} at {}, not {}", next_ + 1, quote(line.text),
                              words(at.t), quote(texts[next_])),
                  at);
    ++next_;
  }

  void on_end(const Moment&, const Outcome&) override {
    if (certain())
      return;
    if (next_ == one_.texts.size())
      return meet();
    miss(fmt::format("{} of {} lines; line {} is missing: {}", next_, one_.texts.size(), next_ + 1,
                     quote(one_.texts[next_])));
  }

private:
  const Expectation& one_;
  std::size_t next_ = 0;
};

/// `end within T`.
class EndJudge final : public Judge {
public:
  explicit EndJudge(const Expectation& one) : one_(one) {}

  void on_end(const Moment& at, const Outcome& outcome) override {
    using run::Reason;
    const auto reason = outcome.ending->reason;
    if (reason == Reason::TimeLimit || reason == Reason::Input)
      return miss(outcome.ending->waits_for.empty()
                      ? fmt::format("it still ran at {}", words(outcome.over))
                      : fmt::format("it waits for {}", outcome.ending->waits_for),
                  at);
    if (outcome.over <= one_.when.to)
      return meet();
    miss(fmt::format("it ended at {}", words(outcome.over)), at);
  }

private:
  const Expectation& one_;
};

/// What is known when the run is over.
class FinalJudge final : public Judge {
public:
  FinalJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void on_end(const Moment&, const Outcome& outcome) override {
    const auto [met, seen] = look(outcome);
    if (met != one_.never)
      meet();
    else
      miss(seen);
  }

private:
  std::pair<bool, std::string> look(const Outcome& outcome) const {
    if (one_.word == Word::Distance)
      return {one_.least <= outcome.way_cm && outcome.way_cm <= one_.most,
              fmt::format("it drove {:.1f} cm", outcome.way_cm)};
    if (one_.word == Word::Lines)
      return {static_cast<double>(outcome.lines) < one_.most, plural(outcome.lines, "line")};
    if (one_.word == Word::Bytes)
      return {static_cast<double>(meaning_.packed_bytes) < one_.most,
              fmt::format("{} bytes", meaning_.packed_bytes)};
    const auto value = outcome.ball->machine().variable(*meaning_.variable);
    return {value == static_cast<std::int32_t>(one_.most),
            fmt::format("{} = {}", one_.name.text, value)};
  }

  const Expectation& one_;
  const Meaning& meaning_;
};

/// What the program has no name for.
class ProblemJudge final : public Judge {
public:
  explicit ProblemJudge(const Meaning& meaning) { miss(meaning.problem); }
};

} // namespace

std::unique_ptr<Judge> make_judge(const Expectation& one, const Meaning& meaning) {
  if (!meaning.problem.empty())
    return std::make_unique<ProblemJudge>(meaning);
  switch (info(one.word).kind) {
  case Kind::State: return std::make_unique<StateJudge>(one, meaning);
  case Kind::Stay: return std::make_unique<StayJudge>(one, meaning);
  case Kind::Event: return std::make_unique<EventJudge>(one, meaning);
  case Kind::Output: return std::make_unique<OutputJudge>(one);
  case Kind::End: return std::make_unique<EndJudge>(one);
  case Kind::Final: return std::make_unique<FinalJudge>(one, meaning);
  }
  return nullptr;
}

bool watches_steps(const Expectation& one) {
  const auto kind = info(one.word).kind;
  return (kind == Kind::State && one.word != Word::Color && one.word != Word::BackLed &&
          one.word != Word::Asleep) ||
         kind == Kind::Stay;
}

std::string words(Duration t) {
  const double seconds = std::chrono::duration<double>(t).count();
  constexpr double short_time = 0.01; // of which hundredths would show nothing
  return seconds > 0 && seconds < short_time ? plain(seconds * 1000, 1) + " ms" // in milliseconds
                                             : plain(seconds, 2) + " s";
}

} // namespace orb::testing
