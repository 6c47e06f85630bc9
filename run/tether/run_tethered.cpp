#include "run/tether/run_tethered.h"

#include "run/live.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::run {
namespace {

/// How long the program may be behind the link: a reaction takes no longer than this.
constexpr Duration shortest_nap = 2ms;
constexpr Duration longest_nap = 20ms;
/// A program that is further behind, because the computer slept, does not hurry after.
constexpr Duration most_behind = 500ms;

/// A run and the robot that it drives.
class Driven {
public:
  Driven(Live& live, Tether& robot, Listener& listener, const TetherOptions& options)
      : live_(live), robot_(robot), listener_(listener), options_(options), origin_(robot.now()) {}

  /// Goes on to the end of the program, or of what the link gives.
  tl::expected<void, Failure> drive() {
    auto driven = drive_on();
    over_ = true;
    return driven;
  }

  std::function<void(const Said&)> hear() {
    return [this](const Said& said) {
      if (!over_) // the time of the program ends with it
        live_.wait(elapsed());
      if (const auto* sample = std::get_if<vm::Sample>(&said.what))
        live_.feel(*sample);
      else if (const auto* collision = std::get_if<vm::event::Collision>(&said.what))
        live_.feel(*collision);
    };
  }

private:
  tl::expected<void, Failure> drive_on() {
    while (true) {
      if (robot_.is_stale()) {
        if (auto back = sit_out(); !back)
          return back;
        continue;
      }
      if (elapsed() - live_.time() > most_behind)
        origin_ = robot_.now() - live_.time();
      if (!live_.advance(elapsed())) {
        if (!live_.waits_for_number() || !listener_.has_more_numbers())
          return {};
        if (const auto number = listener_.ask_number())
          live_.give(*number);
        live_.wait(elapsed());
      }
      const auto nap = std::clamp(live_.next_event() - elapsed(), shortest_nap, longest_nap);
      if (auto pumped = robot_.pump(robot_.now() + nap, hear()); !pumped)
        return pumped;
    }
  }

  Duration elapsed() const { return robot_.now() - origin_; }

  /// Waits for samples; the program waits with it.
  tl::expected<void, Failure> sit_out() {
    const auto paused_at = elapsed();
    if (options_.note)
      options_.note("no sensor data: the robot was told to stop, and the program waits");
    while (robot_.is_stale())
      if (auto pumped = robot_.pump(robot_.now() + longest_nap,
                                    [](const Said&) {}); // what comes first counts from then on
          !pumped)
        return pumped;
    origin_ = robot_.now() - paused_at;
    if (options_.note)
      options_.note("sensor data again: the program goes on");
    return {};
  }

  Live& live_;
  Tether& robot_;
  Listener& listener_;
  const TetherOptions& options_;
  Instant origin_;
  bool over_ = false;
};

} // namespace

tl::expected<TetheredEnding, Failure> run_tethered(std::span<const Input> inputs,
                                                   const Options& given, Listener& listener,
                                                   report::Journey* journey,
                                                   protocol::Transport& transport,
                                                   const TetherOptions& tether) {
  Tether robot(transport, tether.robot, tether.budgets);
  const auto first = robot.begin(tether.aim == Aim::Zero);
  if (!first)
    return tl::unexpected(first.error());
  auto options = given;
  options.robot = &robot;
  options.robot_sample = *first;
  const auto live = Live::start(inputs, options, listener, journey);
  if (!live) {
    robot.finish();
    return tl::unexpected(live.error());
  }
  if (options.asks == Asks::Yes)
    (*live)->keep_waiting();
  Driven run(**live, robot, listener, tether);
  std::optional<Failure> failure;
  if (auto driven = run.drive(); !driven)
    failure = driven.error();
  bool stopped = robot.finish(run.hear());
  std::unique_ptr<protocol::Transport> second;
  if (!stopped && tether.reopen && failure && failure->code == ExitCode::LinkLost) {
    second = tether.reopen();
    if (second != nullptr) {
      robot.relink(*second);
      stopped = robot.finish();
    }
  }
  auto ending = (*live)->finish();
  if (!ending)
    return tl::unexpected(ending.error());
  ending->robot_stopped = stopped;
  if (stopped)
    ending->sight.motion = Sight::Motion::Still;
  return TetheredEnding{*std::move(ending), std::move(failure)};
}

} // namespace orb::run
