#include "debug/timeline.h"

#include "debug/search.h"
#include "run/start.h"
#include "vm/ball_transport.h"

#include <algorithm>
#include <limits>

namespace orb::debug {
namespace {

// Steps between snapshots at first; the distance doubles when there are too many.
constexpr std::uint64_t first_steps_apart = 16'384;
constexpr Duration first_time_apart = 10s;
/// How far the ball runs between two checks.
constexpr Duration slice = 1s;

} // namespace

// Starting.

Timeline::Timeline(std::span<const run::Input> inputs, const run::Options& options,
                   Audience& audience, run::HeldRobot* robot)
    : inputs_(inputs), options_(options), audience_(audience), robot_(robot), voice_(robot),
      steps_apart_(first_steps_apart), time_apart_(first_time_apart) {}

Timeline::~Timeline() = default;

tl::expected<std::unique_ptr<Timeline>, Failure> Timeline::start(std::span<const run::Input> inputs,
                                                                 const run::Options& options,
                                                                 Audience& audience,
                                                                 run::HeldRobot* robot) {
  std::unique_ptr<Timeline> timeline(new Timeline(inputs, options, audience, robot));
  if (auto started = timeline->start(); !started)
    return tl::unexpected(started.error());
  timeline->restore(timeline->copies_.front()); // the client of the first ball has been destroyed
  return timeline;
}

tl::expected<void, Failure> Timeline::start() {
  const auto load = run::load_of(inputs_);
  if (auto why = run::objection(load))
    return tl::unexpected(*std::move(why));
  if (run::streams(load))
    return tl::unexpected(Failure{ExitCode::Usage,
                                  "a streamed macro plays while it arrives and cannot be paused; "
                                  "give it an id other than 254"});
  auto made = run::ball_options(options_);
  if (robot_ != nullptr)
    made.robot = robot_->kind();
  made.native_programs = &native_;
  made.observer = this;
  made.steps = this;
  made.gate = this;
  ball_ = std::make_unique<vm::Ball>(made);
  if (robot_ != nullptr)
    ball_->become(voice_);
  vm::BallTransport transport(*ball_);
  uploader::Session session(transport, {}, 0);
  if (auto done = run::upload(load, options_, *ball_, session); !done)
    return done;
  if (robot_ != nullptr)
    ball_->feel(robot_->first());
  start_ = ball_->now();
  if (run::start(load, options_, *ball_, session) == run::Started::Refused ||
      !(ball_->basic_running() || ball_->macros().running()))
    return tl::unexpected(run::refusal(load, options_));
  Search first;
  first.closed = true;
  search_ = &first;
  ball_->advance_until_quiet(start_); // a macro's first command is due immediately
  search_ = nullptr;
  settle();
  copies_.push_back(copy());
  return {};
}

// Position.

Instant Timeline::instant() const {
  return ball_->machine().held() ? ball_->machine().now() : ball_->now();
}

Moment Timeline::now() const {
  return {step(), ball_->held(), instant()};
}

Timeline::Next Timeline::next() const {
  return ball_->machine().held()  ? Next::Line
         : ball_->macros().held() ? Next::Command
                                  : Next::Nothing;
}

std::int32_t Timeline::sensor(spec::Variable variable) const {
  return ball_->peek(variable, instant());
}

bool Timeline::over() const {
  return !ball_->held() && ball_->quiet();
}

bool Timeline::waits_for_number() const {
  return ball_->machine().waits_for_input() && !ball_->input_queued();
}

// Moving.

/// Runs to the bound, the time or a find, and repeats recorded changes on the way.
Timeline::Reached Timeline::run(Search& search) {
  const auto bound = search.bound;
  for (;;) {
    const auto* change = applied_ < edits_.size() ? &edits_[applied_] : nullptr;
    if (change != nullptr && bound && *bound < change->at)
      change = nullptr;
    search.bound = change != nullptr ? change->at : bound;
    search.at_bound = false;
    if (!search.bound || !(now() == *search.bound))
      if (const auto reached = advance(search); reached != Reached::Bound || change == nullptr)
        return reached;
    if (change == nullptr)
      return Reached::Bound;
    apply(change->edit);
    ++applied_;
  }
}

Timeline::Reached Timeline::advance(Search& search) {
  search_ = &search;
  const auto reached = advance_to_bound(search);
  if (search.gather_to && search.hit)
    resolve(*search.hit, At::End);
  search_ = nullptr;
  return reached;
}

Timeline::Reached Timeline::advance_to_bound(Search& search) {
  const Instant wait_until = search.bound && !search.bound->about_to ? search.bound->at : never;
  const Instant end = std::min(wait_until, search.until);
  for (;;) {
    ball_->advance_until_quiet(next_look(end));
    ball_->take_output();
    if (search.at_bound)
      return Reached::Bound;
    if (search.found || (search.hit && !search.gather_to))
      return Reached::Found;
    if (search.closed)
      return Reached::GivenUp;
    if (over() && wait_until < never)
      ball_->advance_to(wait_until);
    if (ball_->now() >= wait_until)
      return Reached::Bound;
    if (over())
      return Reached::Over;
    if (ball_->now() >= search.until)
      return Reached::Time;
    if (!search.gather_to)
      keep_copy();
    if (search.unwanted())
      return Reached::GivenUp;
    if (voice_.speaks)
      if (const auto reached = hear(search))
        return *reached;
  }
}

/// How far the ball may run before the next check. With a robot, never faster than real time.
Instant Timeline::next_look(Instant end) const {
  if (voice_.speaks)
    return std::min(end, std::max(ball_->now(), start_ + robot_->time()));
  return std::min(end, ball_->now() + slice);
}

/// Waits for data from the robot, which counts as a change.
std::optional<Timeline::Reached> Timeline::hear(Search& search) {
  const auto next = std::min(ball_->next_event(), search.until);
  const auto felt = robot_->hear(next == never ? Duration::max() : next - start_);
  if (!felt) {
    search.closed = true;
    if (felt.error().code == ExitCode::Interrupted)
      return Reached::GivenUp;
    lost_ = felt.error();
    return Reached::Lost;
  }
  search.closed = (*search.give_up)();
  for (const auto& one : *felt) {
    edits_.push_back({now(), one});
    apply(one);
    ++applied_;
  }
  return search.closed ? std::optional(Reached::GivenUp) : std::nullopt;
}

void Timeline::Voice::obey(const vm::Motion& motion) {
  if (speaks)
    robot_->obey(motion);
}

void Timeline::Voice::show(vm::Color color) {
  if (speaks)
    robot_->show(color);
}

void Timeline::Voice::show_back(int level) {
  if (speaks)
    robot_->show_back(level);
}

/// Moves a program that is between two lines to the beginning of the next one.
void Timeline::settle() {
  Search search;
  search.closed = true;
  search_ = &search;
  while (!ball_->held() && ball_->basic_running() && !ball_->machine().waits() && !over())
    ball_->advance_until_quiet(ball_->now() + slice);
  if (!ball_->held())
    ball_->advance_to(ball_->now()); // completes this instant
  search_ = nullptr;
}

Halt Timeline::forward(Watch& watch, Duration until, const GiveUp& give_up, How how) {
  Search search;
  search.watch = &watch;
  search.give_up = &give_up;
  search.until = until == Duration::max() ? never : start_ + until;
  if (how == How::Begins) {
    if (ball_->held())
      search.skip = step();
    watch.begin();
  }
  if (robot_ == nullptr)
    return search_forward(search);
  if (lost_)
    return Halt::Lost;
  edits_.resize(applied_); // drops changes after this moment: the run went back before them
  if (!robot_goes_)
    if (auto goes = robot_->go_on(time()); !goes) {
      lost_ = goes.error();
      return Halt::Lost;
    }
  robot_goes_ = true;
  voice_.speaks = true;
  const auto halt = search_forward(search);
  voice_.speaks = false;
  if (halt != Halt::GivenUp)
    hold();
  return lost_ ? Halt::Lost : halt;
}

void Timeline::hold() {
  if (!std::exchange(robot_goes_, false))
    return;
  if (auto held = robot_->hold(); !held && !lost_)
    lost_ = held.error();
}

Halt Timeline::search_forward(Search& search) {
  switch (run(search)) {
  case Reached::Over: return Halt::Over;
  case Reached::Lost: return Halt::Lost;
  case Reached::Time: settle(); return Halt::Time;
  case Reached::Bound:
  case Reached::GivenUp: settle(); return Halt::GivenUp;
  case Reached::Found: break;
  }
  if (search.hit) {
    settle();
    voice_.speaks = false;
    if (instant() > *search.hit)
      go_to({.step = step(), .at = *search.hit});
  }
  return Halt::Found;
}

Halt Timeline::back(Watch& watch, const GiveUp& give_up) {
  const auto from = now();
  copy_near(from);
  std::vector<const Copy*> bases;
  for (const auto& one : copies_)
    if (one.at < from)
      bases.push_back(&one);
  if (near_ && near_->at < from) {
    const auto after = std::find_if(bases.begin(), bases.end(),
                                    [&](const Copy* one) { return near_->at < one->at; });
    bases.insert(after, near_.get());
  }
  auto end = from;
  for (auto base = bases.rbegin(); base != bases.rend(); ++base) {
    restore(**base);
    Search search;
    search.watch = &watch;
    search.give_up = &give_up;
    search.bound = end;
    search.gather_to = from;
    watch.begin();
    const auto reached = run(search);
    if (reached == Reached::GivenUp) {
      go_to(from);
      return Halt::GivenUp;
    }
    if (search.last) {
      go_to(*search.last);
      return Halt::Found;
    }
    end = (*base)->at;
  }
  restore(copies_.front());
  return Halt::Over;
}

void Timeline::go_to(Moment moment) {
  if (now() == moment)
    return;
  const auto& base = base_before(moment);
  if (moment < now() || now() < base.at)
    restore(base);
  Search search;
  search.bound = moment;
  run(search);
}

void Timeline::begin_again() {
  restore(copies_.front());
  edits_.clear();
  copies_.resize(1);
  near_.reset();
  told_ = 0;
}

void Timeline::tell(report::Journey& journey) {
  const auto here = now();
  restore(copies_.front());
  run::describe(inputs_, options_, journey);
  journey_ = &journey;
  go_to(here);
  journey_ = nullptr;
  journey.sample(time(), ball_->body());
}

// Changes.

bool Timeline::apply(const Edit& edit) {
  if (const auto* set = std::get_if<SetVariable>(&edit)) {
    if (!ball_->basic_running())
      return false;
    ball_->set_variable(set->index, set->value);
  } else if (const auto* go = std::get_if<GoToLine>(&edit)) {
    return ball_->go_to_line(go->line);
  } else if (const auto* number = std::get_if<GiveNumber>(&edit)) {
    ball_->queue_input(number->value);
  } else if (const auto* stimulus = std::get_if<vm::Stimulus>(&edit)) {
    // The change applies before the line that is about to run; the ball's clock may already be
    // within that line.
    const auto at = ball_->machine().held() ? ball_->machine().next_event() : ball_->now();
    const vm::TimedStimulus timed{at - ball_->now(), *stimulus};
    ball_->schedule({&timed, 1});
  } else if (const auto* felt = std::get_if<run::Felt>(&edit)) {
    // Its effects are part of the run, and are replayed with it.
    Search again;
    auto* const before = search_;
    if (before == nullptr)
      search_ = &again;
    if (const auto* battery = std::get_if<vm::stimulus::Battery>(felt))
      ball_->apply(*battery);
    else if (const auto* sample = std::get_if<vm::Sample>(felt))
      ball_->feel(*sample);
    else
      ball_->feel(std::get<vm::event::Collision>(*felt));
    on_step(ball_->now(), ball_->body()); // drives a remote robot's motion
    search_ = before;
  }
  return true;
}

bool Timeline::change(const Edit& edit) {
  const auto at = now();
  if (!apply(edit))
    return false;
  edits_.resize(applied_);
  edits_.push_back({at, edit});
  ++applied_;
  told_ = events_;
  std::erase_if(copies_, [&](const Copy& one) { return at < one.at; });
  if (near_ && at < near_->at)
    near_.reset();
  settle();
  return true;
}

} // namespace orb::debug
