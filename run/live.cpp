#include "run/live.h"

#include "compiler/check.h"
#include "run/start.h"
#include "run/want.h"
#include "run/watcher.h"
#include "vm/ball_transport.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::run {
namespace {

/// The ball's answer to the command that starts the run.
class StartAnswer {
public:
  void take(ByteView bytes) {
    if (code_)
      return;
    decoder_.feed(bytes);
    while (const auto item = decoder_.next())
      if (item->kind == protocol::Item::Kind::Response) {
        code_ = item->code;
        return;
      }
  }
  bool refused() const {
    return code_ && *code_ != static_cast<std::uint8_t>(spec::ResponseCode::Ok);
  }

private:
  protocol::Decoder decoder_{protocol::Direction::FromBall};
  std::optional<std::uint8_t> code_;
};

/// Why a macro aborted by itself; empty if it did not.
std::string_view why(const vm::event::MacroEnd& end) {
  switch (end.reason) {
  case vm::event::MacroEnd::Reason::Ended:
  case vm::event::MacroEnd::Reason::Aborted:
  case vm::event::MacroEnd::Reason::Slept: return {};
  case vm::event::MacroEnd::Reason::NoSuchMacro:
    return "it jumps to an id that no macro on the ball has; add that macro to the command line";
  case vm::event::MacroEnd::Reason::BadCommand:
    return "what follows is not a complete command, or this firmware lacks it; see `orb asm "
           "--listing`";
  case vm::event::MacroEnd::Reason::StreamEnd: return "`stream_end` ends only streams; write `end`";
  case vm::event::MacroEnd::Reason::Inhibited:
    return "it leads to a macro that `inh_if_conn` keeps from running while a client is connected";
  }
  return {};
}

std::string how_aborted(const std::optional<vm::event::MacroEnd>& end) {
  if (!end || why(*end).empty())
    return {};
  return fmt::format("macro {} aborted at command {}: {}", end->macro, end->command, why(*end));
}

Reason reason_of(const vm::Ball& ball, const Watcher& watcher, Instant limit) {
  if (!watcher.faults().empty())
    return Reason::Error;
  if (watcher.is_over_early())
    return Reason::Abort;
  if (ball.basic_running() && ball.quiet())
    return Reason::Input;
  if (!ball.quiet() && ball.now() >= limit)
    return Reason::TimeLimit;
  if (!watcher.end() && watcher.macro_end()) {
    if (watcher.macro_end()->reason == vm::event::MacroEnd::Reason::Slept)
      return Reason::Sleep;
    return why(*watcher.macro_end()).empty() ? Reason::End : Reason::Abort;
  }
  switch (watcher.end().value_or(vm::event::End::Reason::End)) {
  case vm::event::End::Reason::End: return Reason::End;
  case vm::event::End::Reason::Error: return Reason::Error;
  case vm::event::End::Reason::Abort: return Reason::Abort;
  case vm::event::End::Reason::Sleep: return Reason::Sleep;
  }
  return Reason::End;
}

/// What an unfinished run waits for.
std::string waits_for(Reason reason, std::span<const Input> inputs, const Options& options,
                      const vm::Ball& ball) {
  if (reason == Reason::Input)
    return fmt::format("a number at {}", first_with_program(inputs)->program->where(
                                             static_cast<std::uint32_t>(ball.machine().line())));
  const auto found = reason == Reason::TimeLimit ? want(inputs, options) : std::nullopt;
  return found ? std::string(found->what) : std::string();
}

Ending ending_of(std::span<const Input> inputs, const Options& options, const Watcher& watcher,
                 const vm::Ball& ball, Instant limit) {
  Ending ending;
  ending.reason = reason_of(ball, watcher, limit);
  ending.lines = watcher.lines() + (ball.basic_running() ? ball.machine().lines() : 0);
  ending.commands = watcher.commands();
  ending.lasted = watcher.over().value_or(ball.idle_since().value_or(ball.now())) - watcher.start();
  ending.seen_to = options.until == Until::Rest
                       ? std::max(ending.lasted, ball.now() - watcher.start())
                       : ending.lasted;
  ending.seen = watcher.seen();
  ending.only_interpreted = ball.machine().only_interpreted();
  if (const auto* code = ball.machine().machine_code())
    ending.machine_code = code->pieces();
  ending.aborted = how_aborted(watcher.macro_end());
  ending.sight = watcher.sight();
  ending.waits_for = waits_for(ending.reason, inputs, options, ball);
  ending.faults = watcher.faults();
  return ending;
}

} // namespace

struct Live::Impl {
  Impl(std::span<const Input> all, const Options& given, Listener& hears, report::Journey* notes)
      : inputs(all), options(given), listener(hears), journey(notes), load(load_of(all)),
        watcher(load, options, listener, journey), ball(options_of_ball()), transport(ball),
        session(transport, {}, 0) {}

  vm::BallOptions options_of_ball() {
    auto made = ball_options(options);
    made.observer = &watcher;
    made.steps = options.steps == Steps::Heard ? &watcher : nullptr;
    made.trace_lines = options.trace_lines || journey != nullptr;
    return made;
  }

  tl::expected<void, Failure> begin();
  /// Returns Duration::max() for `never`.
  Duration since_start(Instant at) const {
    return at == never ? Duration::max() : at - watcher.start();
  }
  bool rolls() const;
  bool advance(Instant target, vm::Ball::Halt halt);
  Ending so_far() const { return ending_of(inputs, options, watcher, ball, limit); }
  tl::expected<Ending, Failure> finish();

  std::span<const Input> inputs;
  const Options& options;
  Listener& listener;
  report::Journey* journey;
  Load load;
  Watcher watcher;
  vm::Ball ball;
  vm::BallTransport transport;
  uploader::Session session;
  Started started = Started::Yes;
  Instant limit{};
  StartAnswer answer;
};

tl::expected<void, Failure> Live::Impl::begin() {
  if (options.robot != nullptr)
    ball.become(*options.robot);
  if (auto done = upload(load, options, ball, session); !done)
    return done;
  if (options.robot != nullptr)
    ball.feel(options.robot_sample);
  listener.on_start(ball);
  watcher.begin(ball, streams(load) ? Watcher::From::FirstCommand : Watcher::From::Now);
  if (journey != nullptr)
    describe(inputs, options, *journey);
  started = run::start(load, options, ball, session);
  limit = options.bound == Duration{} ? never - 1h : watcher.start() + options.bound;
  return {};
}

/// Returns true if the ball is rolling out. It may still hit something that starts a macro.
bool Live::Impl::rolls() const {
  return options.until == Until::Rest && ball.quiet() && ball.body().moving();
}

bool Live::Impl::advance(Instant target, vm::Ball::Halt halt) {
  constexpr Duration glance = 100ms; // polling interval while the ball rolls out
  if (started == Started::Refused || watcher.is_over_early() || ball.now() >= limit)
    return false;
  target = std::min(target, limit);
  if (rolls()) {
    ball.advance_to(std::min(target, ball.now() + glance), halt);
  } else {
    ball.advance_until_quiet(target, halt);
    answer.take(ball.take_output());
    if (watcher.is_over_early())
      return false;
    if (ball.machine().waits_for_input() && !ball.input_queued())
      if (const auto value = listener.ask_number()) {
        ball.queue_input(*value);
        return true;
      }
    if (ball.quiet())
      return rolls();
  }
  listener.on_time(ball.now() - watcher.start());
  return true;
}

tl::expected<Ending, Failure> Live::Impl::finish() {
  if (started == Started::Refused || answer.refused())
    return tl::unexpected(refusal(load, options));
  const auto ending = so_far();
  listener.on_end(ending);
  if (journey != nullptr)
    journey->finish(ending.seen_to, std::string(to_string(ending.reason)),
                    std::string(manner(ending.reason)));
  return ending;
}

Live::Live(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Live::~Live() = default;

tl::expected<std::unique_ptr<Live>, Failure> Live::start(std::span<const Input> inputs,
                                                         const Options& options, Listener& listener,
                                                         report::Journey* journey) {
  auto impl = std::make_unique<Impl>(inputs, options, listener, journey);
  if (auto why = objection(impl->load))
    return tl::unexpected(*std::move(why));
  if (auto begun = impl->begin(); !begun)
    return tl::unexpected(begun.error());
  return std::unique_ptr<Live>(new Live(std::move(impl)));
}

bool Live::advance(Duration t, vm::Ball::Halt halt) {
  return impl_->advance(impl_->watcher.start() + t, halt);
}

void Live::wait(Duration t, vm::Ball::Halt halt) {
  impl_->ball.advance_to(std::max(impl_->ball.now(), impl_->watcher.start() + t), halt);
}

void Live::keep_waiting() {
  impl_->watcher.keep_waiting();
}

void Live::stop() {
  impl_->watcher.stop();
}

void Live::give(std::int32_t number) {
  impl_->ball.queue_input(number);
}

void Live::apply(const vm::Stimulus& stimulus) {
  impl_->ball.apply(stimulus);
}

void Live::meet(const vm::Shove& shove, std::span<const std::string> names) {
  impl_->ball.meet(shove, names);
}

bool Live::coast(Duration t) {
  return impl_->ball.coast(impl_->watcher.start() + t);
}

Duration Live::next_push() const {
  return impl_->since_start(impl_->ball.next_push());
}

bool Live::over_early() const {
  return impl_->watcher.is_over_early();
}

void Live::feel(const vm::Sample& sample) {
  auto& ball = impl_->ball;
  ball.feel(sample);
  if (impl_->options.steps == Steps::Heard) // a remote robot takes no steps, but sends samples
    impl_->watcher.on_step(ball.now(), ball.body());
}

void Live::feel(const vm::event::Collision& collision) {
  impl_->ball.feel(collision);
}

Duration Live::next_event() const {
  return impl_->since_start(impl_->ball.next_event());
}

Duration Live::time() const {
  return impl_->ball.now() - impl_->watcher.start();
}

const vm::Ball& Live::ball() const {
  return impl_->ball;
}

bool Live::waits_for_number() const {
  return impl_->ball.machine().waits_for_input() && !impl_->ball.input_queued();
}

bool Live::rolls_out() const {
  return impl_->rolls();
}

Ending Live::so_far() const {
  return impl_->so_far();
}

tl::expected<Ending, Failure> Live::finish() {
  return impl_->finish();
}

} // namespace orb::run
