#include "testing/judge.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "testing/sighting.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace orb::testing {
namespace {

// Lines that are kept to find the nearest among; a longer list helps nobody.
constexpr std::size_t most_kept = 50;

/// Words that are true or not at a moment.
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
      return look(from, to, s, false);
    }
    if (!since_)
      since_ = from.t;
    const auto long_enough = *since_ + one_.lasts;
    if (to != never_ends && to - *since_ > longest_) {
      longest_ = to - *since_;
      longest_from_ = {*since_, from.running};
    }
    // What comes after the end is no time in which it lasts.
    if (long_enough > to || (to == never_ends && one_.when.kind == When::Kind::AtEnd))
      return look(from, to, s, long_enough <= from.t);
    if (long_enough > from.t)
      look(from, long_enough, s, false);
    if (!certain())
      look({std::max(from.t, long_enough), from.running}, to, s, true);
  }

  void on_end(const Moment&, const Outcome&) override {
    if (!certain())
      conclude();
  }

  static constexpr Duration never_ends = Duration::max();

private:
  /// It was true, or not, from `from.t` until `to`.
  void look(const Moment& from, Duration to, const Sighting& s, bool is_true) {
    using Kind = When::Kind;
    const auto& when = one_.when;
    switch (when.kind) {
    case Kind::AnyTime: look_for(from, s, never_ends, is_true); break;
    case Kind::Within: look_for(from, s, when.to, is_true); break;
    case Kind::At:
      if (from.t <= when.to && when.to < to)
        decide_at(Moment{when.to, from.running}, s, fmt::format("at {}", words(when.to)), is_true);
      break;
    case Kind::AtEnd:
      if (to == never_ends)
        decide_at(from, s, fmt::format("at the end, {}", words(from.t)), is_true);
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

  /// A moment at which it is true, until `last`.
  void look_for(const Moment& at, const Sighting& s, Duration last, bool is_true) {
    if (at.t > last)
      return;
    if (is_true) {
      if (one_.never)
        miss(fmt::format("{} at {}", seen_of(s, at.t), words(at.t)), at);
      else
        meet(at);
    } else if (const double away = off(one_, meaning_, s); away < nearest_ || best_.empty()) {
      nearest_ = away;
      best_ = describe(one_, meaning_, s);
      best_at_ = at;
    }
  }

  void decide_at(const Moment& at, const Sighting& s, std::string_view moment, bool is_true) {
    if (is_true != one_.never)
      return meet(at);
    miss(fmt::format("{} {}", seen_of(s, at.t), moment), at);
  }

  void check_during(const Moment& at, const Sighting& s, bool is_true) {
    if (is_true == one_.never)
      miss(fmt::format("{} at {}", seen_of(s, at.t), words(at.t)), at);
  }

  /// What was seen, and of what has to last since when.
  std::string seen_of(const Sighting& s, Duration t) const {
    const auto text = describe(one_, meaning_, s);
    return since_ ? fmt::format("{} for {}", text, words(t - *since_)) : text;
  }

  /// It was true at no moment.
  void conclude() {
    if (one_.never || one_.when.kind == When::Kind::During)
      return meet();
    if (longest_ > Duration{} && nearest_ == 0)
      return miss(fmt::format("{} for only {}, starting at {}", best_, words(longest_),
                              words(longest_from_.t)),
                  longest_from_);
    miss(fmt::format("nearest {} at {}", best_, words(best_at_.t)), best_at_);
  }

  const Expectation& one_;
  const Meaning& meaning_;
  std::optional<Duration> since_; ///< where it has to last: true without a break from here on
  Duration longest_{};
  Moment longest_from_;
  double nearest_ = infinite;
  std::string best_;
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

  void see(const Moment&, Duration, const Sighting& s) override { sighting_ = s; }

  void on_print(const Moment& at, const PrintedLine& line) override {
    if (one_.word != Word::Print || certain() || !in_time(at.t))
      return;
    switch (compare(line.text)) {
    case Pattern::Found::Yes: return happen(at, quote(line.text));
    case Pattern::Found::No: return near(at, line.text);
    case Pattern::Found::GaveUp:
      // At once: with the next lines it would be no better, and nobody would wait for it.
      return miss(
          fmt::format("the pattern takes too many steps on {}; simplify it", quote(line.text)), at);
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
    happen(at, "it " + vm::words_of(bump));
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
    if (!one_.joined.empty() && off(one_, meaning_, sighting_) > 0) {
      if (!apart_)
        apart_ = {fmt::format("{} while {}", text, describe(one_, meaning_, sighting_)), at};
      return;
    }
    ++count_;
    if (one_.never)
      return miss(fmt::format("{} at {}", text, words(at.t)), at);
    if (listed_.size() < most_listed)
      listed_.push_back(words(at.t));
    last_ = at;
    if (count_ > one_.times.most)
      miss(count_words(), at);
    else if (count_ >= one_.times.least && one_.times.most == UINT64_MAX)
      meet(at);
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
    if (apart_)
      return miss(fmt::format("{} at {}", apart_->text, words(apart_->at.t)), apart_->at);
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
           : one_.word == Word::Marker    ? "no marker was emitted"
           : one_.word == Word::Collision ? "there was no collision"
                                          : "no error occurred";
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
  Sighting sighting_;         ///< what was seen last
  std::optional<Kept> apart_; ///< it happened while what is joined was not true
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
      return miss(fmt::format("unexpected line: {} at {}", quote(line.text), words(at.t)), at);
    if (line.text != texts[next_])
      return miss(fmt::format("line {} is {} at {}, expected {}", next_ + 1, quote(line.text),
                              words(at.t), quote(texts[next_])),
                  at);
    ++next_;
  }

  void on_end(const Moment&, const Outcome&) override {
    if (certain())
      return;
    if (next_ == one_.texts.size())
      return meet();
    miss(fmt::format("{} of {} lines; missing line {}: {}", next_, one_.texts.size(), next_ + 1,
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
                      ? fmt::format("it was still running at {}", words(outcome.over))
                      : fmt::format("it is waiting for {}", outcome.ending->waits_for),
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
  constexpr double short_time = 0.01; // of which hundredths would show nothing
  return seconds > 0 && seconds < short_time ? plain(seconds * 1000, 1) + " ms" // in milliseconds
                                             : plain(seconds, 2) + " s";
}

} // namespace orb::testing
