#include "testing/judge.h"

#include "base/text/suggest.h"
#include "testing/sighting.h"
#include "testing/texts.h"

#include <algorithm>
#include <limits>

namespace orb::testing {
namespace {

// Enough to choose the nearest from; nobody reads a longer list.
constexpr std::size_t most_kept = 50;

/// Judges words that are true or false at each moment.
class StateJudge final : public Judge {
public:
  StateJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void see(const Moment& from, Duration to, const Sighting& s) override {
    if (certain())
      return;
    const bool is_true = off(one_, meaning_, s) == 0;
    if (one_.lasts == Duration{})
      return look(from, to, s, is_true);
    if (!is_true) {
      since_.reset();
      return look(from, to, s, is_true);
    }
    if (!since_)
      since_ = from.t;
    const auto long_enough = *since_ + one_.lasts;
    if (to != never_ends && to - *since_ > longest_) {
      longest_ = to - *since_;
      longest_from_ = {*since_, from.running};
    }
    bool has_lasted = long_enough <= from.t;
    // A state does not last into the time after the end.
    if (long_enough > to || (to == never_ends && one_.when.kind == When::Kind::AtEnd))
      return look(from, to, s, has_lasted);
    if (!has_lasted)
      look(from, long_enough, s, has_lasted);
    has_lasted = true;
    if (!certain())
      look({std::max(from.t, long_enough), from.running}, to, s, has_lasted);
  }

  void on_end(const Moment&, const Outcome&) override {
    if (!certain())
      conclude();
  }

  static constexpr Duration never_ends = Duration::max();

private:
  /// Records that it was true or false from `from.t` until `to`.
  void look(const Moment& from, Duration to, const Sighting& s, bool is_true) {
    using Kind = When::Kind;
    const auto& when = one_.when;
    switch (when.kind) {
    case Kind::AnyTime: look_for(from, s, never_ends, is_true); break;
    case Kind::Within: look_for(from, s, when.to, is_true); break;
    case Kind::At:
      if (from.t <= when.to && when.to < to)
        decide(Moment{when.to, from.running}, s, texts::At, is_true);
      break;
    case Kind::AtEnd:
      if (to == never_ends)
        decide(from, s, texts::AtTheEnd, is_true);
      break;
    case Kind::During:
      if (from.t <= when.to && to > when.from && to > from.t)
        check_during({std::max(from.t, when.from), from.running}, s, is_true);
      if (!certain() && to > when.to)
        meet();
      break;
    }
    if (!certain() && when.kind == Kind::Within && to > when.to)
      conclude();
  }

  /// Records a moment at which it is true; it stays true until `last`.
  void look_for(const Moment& at, const Sighting& s, Duration last, bool is_true) {
    if (at.t > last)
      return;
    if (is_true) {
      if (one_.never)
        miss(texts::At(seen_of(s, at.t), words(at.t)), at);
      else
        meet(at);
    } else if (const double away = off(one_, meaning_, s); away < nearest_ || best_.empty()) {
      nearest_ = away;
      best_ = describe(one_, meaning_, s);
      best_at_ = at;
    }
  }

  void decide(const Moment& at, const Sighting& s, const Row<Hole::Part, Hole::Name>& when,
              bool is_true) {
    if (is_true != one_.never)
      return meet(at);
    miss(when(seen_of(s, at.t), words(at.t)), at);
  }

  void check_during(const Moment& at, const Sighting& s, bool is_true) {
    if (is_true == one_.never)
      miss(texts::At(seen_of(s, at.t), words(at.t)), at);
  }

  /// Describes what was seen and, for an expectation with a duration, since when it was true.
  Message seen_of(const Sighting& s, Duration t) const {
    auto seen = describe(one_, meaning_, s);
    return since_ ? texts::LastingFor(std::move(seen), words(t - *since_)) : seen;
  }

  /// Decides when it was true at no moment.
  void conclude() {
    if (one_.never || one_.when.kind == When::Kind::During)
      return meet();
    if (longest_ > Duration{} && nearest_ == 0)
      return miss(texts::ForOnly(best_, words(longest_), words(longest_from_.t)), longest_from_);
    miss(texts::NearestAt(best_, words(best_at_.t)), best_at_);
  }

  const Expectation& one_;
  const Meaning& meaning_;
  std::optional<Duration> since_; ///< with a duration: the start of the current unbroken stretch
  Duration longest_{};
  Moment longest_from_;
  double nearest_ = infinite;
  Message best_;
  Moment best_at_;
};

/// `stay`: in the zone at every moment.
class StayJudge final : public Judge {
public:
  StayJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void see(const Moment& from, Duration to, const Sighting& s) override {
    const bool whole = one_.when.kind == When::Kind::AnyTime;
    if (certain() || (!whole && (from.t > one_.when.to || to <= one_.when.from)))
      return;
    if (meaning_.zone->distance_cm({s.x, s.y}) > 0) {
      const Moment at{whole ? from.t : std::max(from.t, one_.when.from), from.running};
      miss(texts::At(describe(one_, meaning_, s), words(at.t)), at);
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

/// Judges words that happen: counts them, and keeps the near misses.
class EventJudge final : public Judge {
public:
  EventJudge(const Expectation& one, const Meaning& meaning) : one_(one), meaning_(meaning) {}

  void see(const Moment&, Duration, const Sighting& s) override { sighting_ = s; }

  void on_print(const Moment& at, const PrintedLine& line) override {
    if (one_.word != Word::Print || certain() || !in_time(at.t))
      return;
    switch (compare(line.text)) {
    case Pattern::Found::Yes: return happen(at, texts::Printed(shown_line(line.text)));
    case Pattern::Found::No: return near(at, texts::Printed(shown_line(line.text)), line.text);
    case Pattern::Found::GaveUp:
      // Fail now: later lines cannot mend it, and waiting costs time.
      return miss(texts::TooManySteps(shown_line(line.text)), at);
    }
  }

  void on_marker(const Moment& at, const vm::event::Marker& marker) override {
    if (one_.word != Word::Marker || certain() || !in_time(at.t))
      return;
    auto what = texts::Marked(marker.marker, marker.macro);
    if (marker.marker == one_.number && (one_.name.text.empty() || marker.macro == meaning_.macro))
      return happen(at, what);
    near(at, what);
  }

  void on_bump(const Moment& at, const vm::event::Bump& bump) override {
    if (one_.word != Word::Collision || certain() || !in_time(at.t))
      return;
    happen(at, bump.ball.empty() ? texts::RanIntoWall(vm::to_string(bump.wall))
                                 : texts::MetBall(bump.ball));
  }

  void on_error(const Moment& at, const run::ProgramError& error) override {
    if (one_.word != Word::Error || certain() || !in_time(at.t))
      return;
    auto text = std::string(spec::info(error.code).text);
    if (one_.error && *one_.error != error.code)
      return near(at, Message::as_is(std::move(text)));
    if (!error.cause.seen.empty())
      text += ": " + error.cause.seen;
    happen(at, Message::as_is(std::move(text)));
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
      happen({outcome.over, at.running}, Message::as_is(aborted));
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

  void happen(const Moment& at, const Message& what) {
    if (!one_.joined.empty() && off(one_, meaning_, sighting_) > 0) {
      if (!apart_)
        apart_ = {{}, texts::While(what, describe(one_, meaning_, sighting_)), at};
      return;
    }
    ++count_;
    if (one_.never)
      return miss(texts::At(what, words(at.t)), at);
    if (count_ <= most_listed)
      listed_ += (listed_.empty() ? "" : ", ") + words(at.t);
    else if (count_ == most_listed + 1)
      listed_ += ", …";
    last_ = at;
    if (count_ > one_.times.most)
      miss(how_often(), at);
    else if (count_ >= one_.times.least && one_.times.most == UINT64_MAX)
      meet(at);
  }

  void near(const Moment& at, const Message& what, std::string_view line = {}) {
    if (kept_.size() >= most_kept)
      return;
    const auto known = std::any_of(kept_.begin(), kept_.end(), [&](const auto& one) {
      return one.line == line && one.what == what;
    });
    if (!known)
      kept_.push_back({std::string(line.substr(0, longest_kept)), what, at});
  }

  Message how_often() const {
    return count_ == 1 ? texts::Once(listed_) : texts::Times(count_, listed_);
  }

  void conclude() {
    if (one_.never || (count_ >= one_.times.least && count_ <= one_.times.most))
      return meet();
    if (count_ > 0)
      return miss(how_often(), last_);
    if (apart_)
      return miss(texts::At(apart_->what, words(apart_->at.t)), apart_->at);
    const Kept* best = nearest();
    if (best == nullptr)
      return miss(nothing_in_time());
    const auto time = words(best->at.t);
    miss(one_.word == Word::Print ? texts::NearestAt(best->what, time)
                                  : texts::At(best->what, time),
         best->at);
  }

  /// Includes the time window unless it is the whole run.
  Message nothing_in_time() const {
    switch (one_.when.kind) {
    case When::Kind::Within: return texts::Until(nothing(), words(one_.when.to));
    case When::Kind::During:
      return texts::FromTo(nothing(), words(one_.when.from), words(one_.when.to));
    case When::Kind::AnyTime:
    case When::Kind::At:
    case When::Kind::AtEnd: break;
    }
    return nothing();
  }

  Message nothing() const {
    return one_.word == Word::Print       ? texts::NothingPrinted()
           : one_.word == Word::Marker    ? texts::NoMarker()
           : one_.word == Word::Collision ? texts::NoCollision()
                                          : texts::NoError();
  }

  struct Kept {
    std::string line; ///< the printed line; empty for other events
    Message what;
    Moment at;
  };

  /// Returns the line most like the expected one, the first of equals.
  const Kept* nearest() const {
    const Kept* best = nullptr;
    std::size_t least = 0;
    for (const auto& one : kept_) {
      const auto distance = edit_distance(one_.text, one.line);
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
  std::string listed_; ///< the first times at which it happened
  std::vector<Kept> kept_;
  Sighting sighting_;         ///< the latest sighting
  std::optional<Kept> apart_; ///< an event during which a joined state was false
  std::optional<Moment> last_;
};

/// `prints`: exactly these lines, in this order.
class OutputJudge final : public Judge {
public:
  explicit OutputJudge(const Expectation& one) : one_(one) {}

  void on_print(const Moment& at, const PrintedLine& line) override {
    if (certain())
      return;
    if (next_ == one_.texts.size())
      return miss(texts::UnexpectedLine(shown_line(line.text), words(at.t)), at);
    const auto& wanted = one_.texts[next_++];
    if (line.text != wanted)
      miss(texts::OtherLine(next_, shown_line(line.text), words(at.t), shown_line(wanted)), at);
  }

  void on_end(const Moment&, const Outcome&) override {
    if (certain())
      return;
    if (next_ == one_.texts.size())
      return meet();
    miss(texts::MissingLine(next_, one_.texts.size(), next_ + 1, shown_line(one_.texts[next_])));
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
      return miss(outcome.ending->waits_for.empty() ? texts::StillRunning(words(outcome.over))
                                                    : texts::WaitsFor(outcome.ending->waits_for),
                  at);
    if (outcome.over <= one_.when.to)
      return meet();
    miss(texts::Ended(words(outcome.over)), at);
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
  std::pair<bool, Message> look(const Outcome& outcome) const {
    if (one_.word == Word::Distance)
      return {one_.least <= outcome.way_cm && outcome.way_cm <= one_.most,
              texts::Drove(decimal(outcome.way_cm, 1))};
    if (one_.word == Word::Lines)
      return {static_cast<double>(outcome.lines) < one_.most,
              counted(outcome.lines, texts::OneLine, texts::Lines)};
    if (one_.word == Word::Bytes)
      return {static_cast<double>(meaning_.packed_bytes) < one_.most,
              texts::Bytes(meaning_.packed_bytes)};
    const auto value = outcome.ball->machine().variable(*meaning_.variable);
    return {value == static_cast<std::int32_t>(one_.most),
            Message::as_is(one_.name.text + " = " + std::to_string(value))};
  }

  const Expectation& one_;
  const Meaning& meaning_;
};

/// A name that the program does not have.
class ProblemJudge final : public Judge {
public:
  explicit ProblemJudge(const Meaning& meaning) { miss(meaning.problem); }
};

} // namespace

std::unique_ptr<Judge> make_judge(const Expectation& one, const Meaning& meaning) {
  if (!meaning.problem.empty())
    return std::make_unique<ProblemJudge>(meaning);
  if (one.order != Order::Free)
    return make_order_judge(one, meaning);
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
         kind == Kind::Stay || std::any_of(one.joined.begin(), one.joined.end(), watches_steps) ||
         (one.other && watches_steps(*one.other));
}

std::string words(Duration t) {
  const double seconds = std::chrono::duration<double>(t).count();
  constexpr double short_time = 0.01; // seconds; below this, hundredths would round to nothing
  return seconds > 0 && seconds < short_time ? plain(seconds * 1000, 1) + " ms" // in milliseconds
                                             : plain(seconds, 2) + " s";
}

} // namespace orb::testing
