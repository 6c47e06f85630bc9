#include "debug/timeline.h"

#include "run/start.h"
#include "vm/ball_transport.h"

#include <algorithm>
#include <limits>

namespace orb::debug {
namespace {

// How far the copies of a ball lie apart at first. When there are too many, every second one goes
// and the distances double.
constexpr std::uint64_t first_steps_apart = 16'384;
constexpr Duration first_time_apart = 10s;
constexpr std::size_t most_copies = 64;
/// Steps between a place from which somebody went back and the copy that is kept close before it.
constexpr std::uint64_t near_steps = 4096;
/// How long the ball lives before it is looked at.
constexpr Duration slice = 1s;
constexpr std::int64_t lines_at_once = 1 << 20;
/// Questions between two looks at whether the search is still wanted.
constexpr std::uint32_t questions_between_looks = 1 << 14;

std::size_t bytes_of(const vm::Ball& ball) {
  const auto& core = ball.machine().core();
  return sizeof(vm::Ball) + core.code.capacity() * sizeof(vm::Code) +
         core.chunk.code.capacity() * sizeof(bytecode::Instruction) +
         core.chunk.lines.capacity() * sizeof(bytecode::Line) +
         core.registers.capacity() * sizeof(std::int32_t) +
         core.reciprocals.capacity() * sizeof(std::int64_t) +
         core.chunk.texts.capacity() * sizeof(std::string) +
         ball.basic_text(spec::Area::Ram).size() + ball.basic_text(spec::Area::Flash).size();
}

} // namespace

/// A ball as it was at a moment, and what the timeline had counted by then.
struct Timeline::Copy {
  Moment at;
  std::unique_ptr<vm::Ball> ball;
  std::uint64_t commands = 0;
  std::uint64_t events = 0;
  std::size_t applied = 0;
};

/// One way through a run.
struct Timeline::Search {
  Watch* watch = nullptr;                 ///< null: nothing is looked for
  const GiveUp* give_up = nullptr;        ///< null: never
  std::optional<Moment> bound = {};       ///< where it ends
  Instant until = never;                  ///< the same as a time
  std::optional<std::uint64_t> skip = {}; ///< the step that it stands before and does not find
  std::optional<Moment> gather_to = {};   ///< finds before this are noted, and it goes on

  // What has come of it.
  bool at_bound = false;
  bool found = false;
  bool closed = false;          ///< nothing may begin any more
  std::optional<Instant> hit{}; ///< an event was found; where the run stands then is still open
  std::optional<Moment> last{}; ///< the last find that was noted
  std::uint32_t questions = 0;

  void note(const Moment& moment) {
    if (!(moment < *gather_to))
      return;
    last = moment;
    watch->noted();
  }
  bool unwanted() {
    if (give_up == nullptr || ++questions < questions_between_looks)
      return false;
    questions = 0;
    closed = (*give_up)();
    return closed;
  }
};

// Beginning.

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
  timeline->restore(timeline->copies_.front()); // the client of the first ball is gone
  return timeline;
}

tl::expected<void, Failure> Timeline::start() {
  const auto load = run::load_of(inputs_);
  if (auto why = run::objection(load))
    return tl::unexpected(*std::move(why));
  if (run::streams(load))
    return tl::unexpected(Failure{ExitCode::Usage,
                                  "a streamed macro plays while it arrives and cannot stand still; "
                                  "give it another id than 254"});
  auto made = run::ball_options(options_);
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
  ball_->advance_until_quiet(start_); // a macro's first command is due at once
  search_ = nullptr;
  settle();
  copies_.push_back(copy());
  return {};
}

// Where it stands.

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

// Copies.

Timeline::Copy Timeline::copy() const {
  return {now(), std::make_unique<vm::Ball>(*ball_), commands_, events_, applied_};
}

void Timeline::restore(const Copy& copy) {
  ball_ = std::make_unique<vm::Ball>(*copy.ball);
  commands_ = copy.commands;
  events_ = copy.events;
  applied_ = copy.applied;
}

/// The last copy that is not after `moment`.
const Timeline::Copy& Timeline::base_before(const Moment& moment) const {
  const auto after =
      std::upper_bound(copies_.begin() + 1, copies_.end(), moment,
                       [](const Moment& wanted, const Copy& one) { return wanted < one.at; });
  const auto& kept = *std::prev(after);
  return near_ && !(moment < near_->at) && kept.at < near_->at ? *near_ : kept;
}

void Timeline::keep_copy() {
  const auto& last = copies_.back();
  if (ball_->held() || !(last.at < now()) ||
      (step() - last.at.step < steps_apart_ && ball_->now() - last.at.at < time_apart_))
    return;
  copies_.push_back(copy());
  if (copies_.size() < most_copies)
    return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < copies_.size(); i += 2)
    std::swap(copies_[kept++], copies_[i]);
  copies_.resize(kept);
  steps_apart_ *= 2;
  time_apart_ *= 2;
}

/// Keeps a copy close before `moment`, so that the next steps back from there are short.
void Timeline::copy_near(const Moment& moment) {
  if (near_ && near_->at < moment && moment.step - near_->at.step <= 2 * near_steps)
    return;
  const auto& base = base_before(moment);
  if (moment.step < base.at.step + near_steps)
    return;
  restore(base);
  Search search;
  search.bound = Moment{moment.step - near_steps, true, {}};
  run(search);
  near_ = std::make_unique<Copy>(copy());
}

Timeline::Size Timeline::size() const {
  Size size{copies_.size() + (near_ ? 1 : 0), 0};
  size.bytes = size.copies * bytes_of(*ball_);
  return size;
}

// What the ball asks and tells on its way.

std::int64_t Timeline::lines() {
  if (!may_begin(true))
    return 0;
  if (search_->watch != nullptr && search_->watch->wants_lines())
    return 1;
  search_->questions += questions_between_looks / 64; // many lines run now
  if (!search_->bound)
    return lines_at_once;
  return std::min(lines_at_once, static_cast<std::int64_t>(search_->bound->step - step()));
}

bool Timeline::command() {
  if (!may_begin(false))
    return false;
  ++commands_;
  return true;
}

bool Timeline::may_begin(bool is_line) {
  if (search_ == nullptr)
    return false;
  auto& search = *search_;
  if (search.gather_to && search.hit)
    resolve(is_line ? ball_->machine().now() : ball_->now(), true);
  if (search.bound && step() >= search.bound->step) {
    search.at_bound = true;
    return false;
  }
  if (search.skip == step())
    return true;
  if (search.closed || search.hit || search.unwanted())
    return false;
  auto* watch = search.watch;
  if (watch == nullptr || !(is_line ? watch->wants_lines() && watch->line() : watch->command()))
    return true;
  if (search.gather_to) {
    search.note({step(), true, {}});
    return true;
  }
  search.found = true;
  return false;
}

void Timeline::on_event(Instant at, const vm::Event& event) {
  if (search_ == nullptr)
    return;
  if (journey_ != nullptr) {
    journey_->add(at - start_, event);
    journey_->sample(at - start_, ball_->body());
  }
  if (++events_ > told_) {
    told_ = events_;
    audience_.on_event(at - start_, event);
  }
  if (search_->watch != nullptr && search_->watch->event(event))
    hit(at);
  if (search_->unwanted())
    ball_->interrupt();
}

void Timeline::on_step(Instant at, const vm::Body&) {
  if (search_ == nullptr)
    return;
  if (search_->watch != nullptr && search_->watch->motion(at - start_))
    hit(at);
  if (search_->unwanted())
    ball_->interrupt();
}

/// Something between two steps was found. Where a program is under way, the run stands still before
/// its next line; else at this very instant.
void Timeline::hit(Instant at) {
  auto& search = *search_;
  if (search.gather_to) {
    const bool waits = !ball_->basic_running() || ball_->machine().waits();
    if (search.hit && *search.hit < at && waits)
      search.note({step(), false, *search.hit});
    search.hit = at;
  } else if (!search.hit) {
    search.hit = at;
    ball_->interrupt();
  }
}

/// A find whose place was open: at `at` the next step begins, or the search ends.
void Timeline::resolve(Instant at, bool about_to) {
  auto& search = *search_;
  const auto found = *std::exchange(search.hit, std::nullopt);
  if (at > found || (!about_to && (!ball_->basic_running() || ball_->machine().waits())))
    search.note({step(), false, found});
  else
    search.note({step(), true, {}});
}

// Going.

/// Goes on to the bound, the time or a find, and changes on the way what was changed there.
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
    resolve(*search.hit, false);
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

/// How far the ball may live before it is looked at: a robot's run is no faster than the robot.
Instant Timeline::next_look(Instant end) const {
  if (voice_.speaks)
    return std::min(end, std::max(ball_->now(), start_ + robot_->time()));
  return std::min(end, ball_->now() + slice);
}

/// Waits for what the robot says. That is a change like those that users make.
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

/// Lets a program that is between two lines come to the beginning of the next one.
void Timeline::settle() {
  Search search;
  search.closed = true;
  search_ = &search;
  while (!ball_->held() && ball_->basic_running() && !ball_->machine().waits() && !over())
    ball_->advance_until_quiet(ball_->now() + slice);
  if (!ball_->held())
    ball_->advance_to(ball_->now()); // what else is due at this instant
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
  edits_.resize(applied_); // of a moment that it has come back from
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
      go_to({step(), false, *search.hit});
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
    // Before the line that is about to run: the ball's own clock may already be within that line.
    const auto at = ball_->machine().held() ? ball_->machine().next_event() : ball_->now();
    const vm::TimedStimulus timed{at - ball_->now(), *stimulus};
    ball_->schedule({&timed, 1});
  } else if (const auto* felt = std::get_if<run::Felt>(&edit)) {
    // What follows from it is part of the run, also where it happens again.
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
    on_step(ball_->now(), ball_->body()); // this is how a robot elsewhere moves on
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
