// Judges of `after` and `before`.

#include "testing/judge.h"
#include "testing/texts.h"

#include <algorithm>

namespace orb::testing {
namespace {

/// The expectation without its relation.
Expectation alone(Expectation one) {
  one.order = Order::Free;
  one.other = nullptr;
  return one;
}

When shifted(When when, Duration by) {
  when.from += by;
  when.to += by;
  return when;
}

/// Waits for the other event, then judges as if the run had begun there.
class AfterJudge final : public Judge {
public:
  AfterJudge(const Expectation& one, const Meaning& meaning)
      : one_(one), meaning_(meaning), first_(make_judge(*one.other, *meaning.other)),
        later_(alone(one)) {}

  void see(const Moment& from, Duration to, const Sighting& s) override {
    if (certain())
      return;
    if (!second_)
      hear_first([&](Judge& judge) { judge.see(from, to, s); });
    if (second_)
      hear([&](Judge& judge) { judge.see({std::max(from.t, begin_), from.running}, to, s); });
  }
  void on_print(const Moment& at, const PrintedLine& line) override {
    happen([&](Judge& judge) { judge.on_print(at, line); });
  }
  void on_marker(const Moment& at, const vm::event::Marker& marker) override {
    happen([&](Judge& judge) { judge.on_marker(at, marker); });
  }
  void on_bump(const Moment& at, const vm::event::Bump& bump) override {
    happen([&](Judge& judge) { judge.on_bump(at, bump); });
  }
  void on_error(const Moment& at, const run::ProgramError& error) override {
    happen([&](Judge& judge) { judge.on_error(at, error); });
  }
  void on_time(Duration t) override {
    if (second_)
      hear([&](Judge& judge) { judge.on_time(t); });
  }
  void on_end(const Moment& at, const Outcome& outcome) override {
    if (certain())
      return;
    if (!second_)
      hear_first([&](Judge& judge) { judge.on_end(at, outcome); });
    if (second_)
      return hear([&](Judge& judge) { judge.on_end(at, outcome); });
    if (one_.never)
      return meet();
    miss(texts::FirstNeverHappened(first_->seen()), first_->moment());
  }

private:
  /// An event counts as the first or the second, never as both.
  template <class Tell>
  void happen(Tell tell) {
    if (certain())
      return;
    if (second_)
      hear(tell);
    else
      hear_first(tell);
  }

  template <class Tell>
  void hear_first(Tell tell) {
    if (!first_->certain())
      tell(*first_);
    if (first_->decision() != Decision::Met)
      return;
    begin_ = first_->moment() ? first_->moment()->t : Duration{};
    if (later_.when.kind != When::Kind::AnyTime && later_.when.kind != When::Kind::AtEnd)
      later_.when = shifted(later_.when, begin_);
    second_ = make_judge(later_, meaning_);
  }

  template <class Tell>
  void hear(Tell tell) {
    if (certain())
      return;
    tell(*second_);
    if (!second_->certain())
      return;
    if (second_->decision() == Decision::Missed)
      return miss(second_->seen(), second_->moment());
    if (!one_.lag || !second_->moment())
      return meet(second_->moment());
    const auto lag = second_->moment()->t - begin_;
    if (lag >= *one_.lag - one_.lag_by && lag <= *one_.lag + one_.lag_by)
      return meet(second_->moment());
    miss(texts::Later(words(lag), words(second_->moment()->t)), second_->moment());
  }

  const Expectation& one_;
  const Meaning& meaning_;
  std::unique_ptr<Judge> first_;
  Expectation later_; ///< its times, measured from the start of the run; set once the other event
                      ///< has happened
  std::unique_ptr<Judge> second_;
  Duration begin_{};
};

/// Judges which of the two comes first.
class BeforeJudge final : public Judge {
public:
  BeforeJudge(const Expectation& one, const Meaning& meaning)
      : never_(one.never), mine_(alone(one)) {
    mine_.never = false;
    first_ = make_judge(mine_, meaning);
    other_ = make_judge(*one.other, *meaning.other);
  }

  void see(const Moment& from, Duration to, const Sighting& s) override {
    hear([&](Judge& judge) { judge.see(from, to, s); });
  }
  void on_print(const Moment& at, const PrintedLine& line) override {
    hear([&](Judge& judge) { judge.on_print(at, line); });
  }
  void on_marker(const Moment& at, const vm::event::Marker& marker) override {
    hear([&](Judge& judge) { judge.on_marker(at, marker); });
  }
  void on_bump(const Moment& at, const vm::event::Bump& bump) override {
    hear([&](Judge& judge) { judge.on_bump(at, bump); });
  }
  void on_error(const Moment& at, const run::ProgramError& error) override {
    hear([&](Judge& judge) { judge.on_error(at, error); });
  }
  void on_end(const Moment& at, const Outcome& outcome) override {
    hear([&](Judge& judge) { judge.on_end(at, outcome); });
    if (certain())
      return;
    if (never_)
      meet();
    else
      miss(first_->seen(), first_->moment());
  }

private:
  template <class Tell>
  void hear(Tell tell) {
    if (certain())
      return;
    for (auto* judge : {first_.get(), other_.get()})
      if (!judge->certain())
        tell(*judge);
    const bool came = first_->decision() == Decision::Met;
    const bool other_came = other_->decision() == Decision::Met;
    if (other_came && (!came || time_of(*other_) < time_of(*first_)))
      return never_ ? meet(other_->moment())
                    : miss(texts::OtherCameFirst(words(time_of(*other_))), other_->moment());
    if (came)
      return never_ ? miss(texts::ItCameFirst(words(time_of(*first_))), first_->moment())
                    : meet(first_->moment());
  }

  static Duration time_of(const Judge& judge) {
    return judge.moment() ? judge.moment()->t : Duration{};
  }

  bool never_;
  Expectation mine_;
  std::unique_ptr<Judge> first_;
  std::unique_ptr<Judge> other_;
};

} // namespace

std::unique_ptr<Judge> make_order_judge(const Expectation& one, const Meaning& meaning) {
  if (one.order == Order::After)
    return std::make_unique<AfterJudge>(one, meaning);
  return std::make_unique<BeforeJudge>(one, meaning);
}

} // namespace orb::testing
