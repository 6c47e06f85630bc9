#include "vm/ball.h"

#include "protocol/payload.h"
#include "vm/ball_asks.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::vm {
namespace {

using spec::BasicFlag;
using spec::MacroFlag;

constexpr Duration pose_interval = std::chrono::milliseconds{50};

ProgramOptions program_options(const BallOptions& options) {
  ProgramOptions programs = options;
  const auto& firmware = spec::info(options.firmware);
  programs.language = firmware.language();
  if (firmware.ranges == spec::Ranges::Lenient)
    programs.ranges = spec::Ranges::Lenient;
  return programs;
}

} // namespace

Ball::Ball(const BallOptions& options)
    : asks_(std::make_unique<Asks>(*this)), observer_(options.observer), gate_(options.gate),
      body_(options.seed, options.driving, options.start, options.robot), link_(options.wire),
      drive_(body_, settings_), power_(settings_),
      programs_(program_options(options), options.seed),
      macros_(asks_->of_macro, spec::info(options.firmware).macro_executive()),
      dispatcher_(asks_->of_client, options.seed, options.firmware) {
  body_.observe(options.steps);
  const auto battery = spec::battery(options.robot);
  constexpr double hundredths = 100; // of a volt
  settings_.low_battery_cv = static_cast<int>(std::lround(battery.low * hundredths));
  settings_.critical_battery_cv = static_cast<int>(std::lround(battery.critical * hundredths));
}

Ball::Ball(const Ball& other)
    : asks_(std::make_unique<Asks>(*this)), observer_(other.observer_), gate_(other.gate_),
      now_(other.now_), settings_(other.settings_), body_(other.body_), link_(other.link_),
      lamps_(other.lamps_), drive_(other.drive_, body_, settings_), power_(other.power_),
      programs_(other.programs_), macros_(other.macros_, asks_->of_macro),
      streamer_(other.streamer_), dispatcher_(other.dispatcher_, asks_->of_client),
      script_(other.script_), interrupted_(other.interrupted_), idle_since_(other.idle_since_),
      double_shake_(other.double_shake_), shakes_(other.shakes_), deaf_until_(other.deaf_until_),
      watch_at_(other.watch_at_), felt_at_(other.felt_at_), was_moving_(other.was_moving_),
      rest_unseen_(other.rest_unseen_) {}

Ball::~Ball() = default;

void Ball::trace(const Event& event) {
  if (!observer_)
    return;
  catch_up();
  observer_->on_event(now_, event);
}

// The link.

void Ball::connect() {
  if (asleep())
    wake();
  if (connected())
    return;
  link_.connect();
  stay_awake();
  show_lamps();
}

void Ball::disconnect() {
  if (!connected())
    return;
  link_.disconnect();
  lamps_.release(Actor::Client);
  dispatcher_.on_disconnect();
  streamer_.stop();
  show_lamps();

  const auto once = spec::temporary_option_flags::stop_on_disconnect;
  const bool macro_forbids = macros_.running() && !macros_.has(MacroFlag::AllowSod);
  const bool basic_forbids = programs_.running() && !programs_.has(BasicFlag::StopOnDisconnect);
  if ((settings_.temporary_flags & once) != 0 && !macro_forbids && !basic_forbids) {
    body_.obey(Stop{});
    settings_.temporary_flags &= ~once;
  }
}

void Ball::receive(ByteView bytes) {
  if (connected() && !asleep())
    dispatcher_.receive(bytes);
}

Bytes Ball::take_output() {
  Bytes all;
  while (const auto packet = take_packet())
    all.insert(all.end(), packet->begin(), packet->end());
  return all;
}

// Time.

/// The next event other than motion and the program.
Instant Ball::next_of_others() const {
  Instant next = std::min({drive_.next_event(), watch_at_, power_.next_event(body_, settings_),
                           dispatcher_.next_event()});
  if (!script_.empty())
    next = std::min(next, Instant{} + script_.back().at);
  if (asleep())
    return next;
  if (observer_ && !connected())
    next = std::min(next, lamps_.next_blink(lamp_situation()));
  return std::min({next, macros_.next_event(), streamer_.next_event()});
}

/// The next step that may have an effect. Steps before the battery can change state have none; from
/// then on every step checks the battery.
Instant Ball::next_step_of_note() const {
  if (asleep() || !body_.rolls_freely() || power_.sleeps_soon(now_))
    return next_step();
  const Instant holds = power_.battery_holds_until();
  return std::max(body_.next_step(), holds - holds.time_since_epoch() % Body::step);
}

/// Brings a body that was left behind, because nothing could happen to it, up to now.
void Ball::catch_up() {
  if (body_.rolls_freely() && body_.next_step() <= now_)
    body_.advance_to(now_);
}

Instant Ball::next_event() const {
  if (power_.falls_asleep())
    return now_;
  return std::max(
      now_, std::min({next_of_others(), next_step(), programs_.next_event(), link_.next_event()}));
}

void Ball::advance_to(Instant target, Halt halt) {
  advance(target, Until::Target, halt);
}

void Ball::advance_until_quiet(Instant target, Halt halt) {
  interrupted_ = false;
  advance(target, Until::Quiet, halt);
}

void Ball::advance_until_output(Instant target, Halt halt) {
  advance(target, Until::Output, halt);
}

void Ball::advance(Instant target, Until until, Halt halt) {
  programs_.let_go();
  calm_until_ = {};
  for (;;) {
    if (until == Until::Output && link_.next_event() <= now_) {
      catch_up();
      return;
    }
    if (until == Until::Quiet) {
      if (!idle())
        idle_since_.reset();
      else if (!idle_since_)
        idle_since_ = now_;
      if (interrupted_ || quiet()) {
        catch_up();
        return;
      }
      if (idle_since_) // only output is left to send
        target = std::min(target, link_.drained_to(0, now_));
    }
    const Instant others = next_of_others();
    const Instant event = power_.falls_asleep() ? now_ : std::min(others, next_step_of_note());
    const Instant limit = std::min(event, target + Duration{1});
    if (programs_.answer_input(now_)) {
      finish_program();
      continue;
    }
    const Instant due = std::min(others, programs_.next_event());
    if (rest_unseen_ && (due <= target || halt == Halt::Look)) {
      run_events(std::min(due, target));
      continue;
    }
    if (programs_.next_event() < limit) {
      now_ = std::max(now_, programs_.run(limit, asks_->of_program));
      finish_program();
      if (programs_.machine().held()) {
        body_.advance_to(now_);
        return;
      }
      continue;
    }
    const bool only_motion = halt == Halt::Pass && due > target && !power_.falls_asleep();
    if (event > target || (only_motion && pass(target))) {
      calm_until_ = rest_unseen_ ? now_ : std::min(due, power_.battery_holds_until());
      break;
    }
    if (!only_motion)
      run_events(std::min(due, target));
    if (macros_.held())
      return;
  }
  now_ = std::max(now_, target);
  body_.advance_to(now_);
}

bool Ball::idle() const {
  const auto nobody_answers = [&] {
    return std::none_of(script_.begin(), script_.end(), [](const auto& event) {
      return std::holds_alternative<stimulus::Number>(event.stimulus);
    });
  };
  return (!programs_.running() || (programs_.waits_in_vain() && nobody_answers())) &&
         !macros_.running() && power_.wake_at() == never && !power_.falls_asleep();
}

/// Advances to the target, or to the first event that motion causes. The caller guarantees that
/// only motion is due until then. Returns true if motion caused nothing.
bool Ball::pass(Instant target) {
  now_ = std::max(now_, body_.advance_to(target));
  rest_unseen_ = was_moving_ && !body_.moving();
  if (!body_.struck())
    return !rest_unseen_;
  run_events(now_);
  return false;
}

void Ball::run_events(Instant others) {
  // Motion continues until something else is due, or until it causes an event itself.
  now_ = std::max(now_, body_.advance_to(std::max(now_, others)));
  if (const auto impact = body_.take_impact()) {
    if (impact->wall)
      trace(event::Bump{*impact->wall, impact->speed});
    detect_collision(*impact);
  }
  watch_motion();
  run_housekeeping();
  run_script();
  if (dispatcher_.next_event() <= now_)
    dispatcher_.run(now_);
  if (!asleep() && macros_.next_event() <= now_)
    macros_.advance_to(now_);
  if (macros_.held())
    return; // the rest of this instant runs after the host lets go
  settle();
  if (!asleep())
    if (const auto full = streamer_.run(now_, body_))
      send(*full);
  if (power_.falls_asleep())
    fall_asleep();
}

void Ball::run_script() {
  while (!script_.empty() && Instant{} + script_.back().at <= now_) {
    const auto stimulus = script_.back().stimulus;
    script_.pop_back();
    apply(stimulus);
  }
}

void Ball::run_housekeeping() {
  if (now_ >= power_.wake_at())
    wake();
  drive_.run(now_);
  if (asleep())
    return;
  watch_battery();
  if (!connected())
    show_lamps(); // the identification colours blink
  if (keeps_awake() && power_.sleeps_soon(now_))
    stay_awake();
  if (power_.warns(now_)) {
    power_.warned();
    send(protocol::make_async(spec::AsyncId::PreSleepWarning));
  }
  if (power_.inactive(now_))
    power_.ask_to_sleep({});
}

/// Applies the effects of what has finished since the last call.
void Ball::settle() {
  finish_program();
  if (const auto macro = macros_.take_finished()) {
    trace(macro->end);
    lamps_.release(Actor::Macro);
    if (!spec::has_flag(macro->flags, MacroFlag::Stealth))
      stay_awake();
    show_lamps();
  }
  share_drive();
}

void Ball::finish_program() {
  const auto stop = programs_.take_termination();
  if (!stop)
    return;
  if (stop->error) {
    trace(event::Error{stop->line, *stop->error});
    const auto text = fmt::format("Line {}: {}\n", stop->line, spec::info(*stop->error).text);
    send(protocol::make_async(spec::AsyncId::BasicErrorText, {as_bytes(text)}));
    send(protocol::make_async(spec::AsyncId::BasicError, {stop->line, spec::code(*stop->error)}));
  }
  if (!programs_.has(BasicFlag::Stealth))
    stay_awake();
  trace(event::End{stop->reason, stop->lines});
  programs_.set_flags(0);
  lamps_.release(Actor::Basic);
  share_drive();
  show_lamps();
}

void Ball::watch_motion() {
  const bool moving = body_.moving() && !asleep();
  if (moving && !was_moving_) {
    watch_at_ = now_;
    dispatcher_.on_motion();
  }
  if (now_ >= watch_at_ || (was_moving_ && !moving)) {
    trace(event::Position{body_.pose(), felt_at_ ? std::optional(now_ - *felt_at_) : std::nullopt});
    watch_battery();
    watch_at_ = moving ? now_ + pose_interval : never;
  }
  was_moving_ = moving;
  rest_unseen_ = false;
}

// Stimuli.

void Ball::schedule(std::span<const TimedStimulus> script) {
  for (const auto& event : script)
    script_.push_back({now_.time_since_epoch() + event.at, event.stimulus});
  std::reverse(script_.end() - static_cast<std::ptrdiff_t>(script.size()), script_.end());
  std::stable_sort(script_.begin(), script_.end(),
                   [](const auto& a, const auto& b) { return a.at > b.at; });
}

} // namespace orb::vm
