#include "run/tether/run_tethered.h"

#include "base/contain.h"
#include "run/live.h"
#include "run/tether/driven.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::run {
namespace {

struct Nobody final : Listener {
  void on_event(Duration, const vm::Event&) override {}
  void on_fault(Duration, const ProgramError&) override {}
};

/// Forwards everything and records the numbers given.
class Tap final : public Listener {
public:
  Tap(Listener& inner, std::function<void(std::int32_t)> on_number)
      : inner_(&inner), on_number_(std::move(on_number)) {}

  /// Stops forwarding, because the inner listener has thrown.
  void close() { inner_ = &nobody_; }

  void on_start(const vm::Ball& ball) override { inner_->on_start(ball); }
  void on_event(Duration t, const vm::Event& event) override { inner_->on_event(t, event); }
  void on_fault(Duration t, const ProgramError& fault) override { inner_->on_fault(t, fault); }
  void on_step(Duration t, const vm::Body& body) override { inner_->on_step(t, body); }
  void on_time(Duration t) override { inner_->on_time(t); }
  void on_end(const Ending& ending) override { inner_->on_end(ending); }
  bool enough() const override { return inner_->enough(); }
  bool has_more_numbers() const override { return inner_->has_more_numbers(); }
  std::optional<std::int32_t> ask_number() override {
    const auto number = on_number_ ? inner_->ask_number() : std::nullopt;
    if (number)
      on_number_(*number);
    return number;
  }

private:
  Nobody nobody_;
  Listener* inner_;
  std::function<void(std::int32_t)> on_number_; ///< empty: numbers come from another source
};

/// Returns for example `roll 90 60 1` at 0.400 s.
std::string drive_words(const DriveLine& command) {
  return fmt::format("`{}` at {:.6f} s", std::get<DriveLine::SentCommand>(command.what).words,
                     std::chrono::duration<double>(command.at).count());
}

/// Reports that the robot may still be driving.
void tell_stop(Listener& listener, report::Journey* journey, Duration t, bool stopped) {
  if (stopped)
    return;
  listener.on_event(t, vm::event::StopLost{});
  if (journey != nullptr)
    journey->add(t, vm::event::StopLost{});
}

bool is_bug(const std::optional<Failure>& failure) {
  return failure && failure->code == ExitCode::Bug;
}

Ending finished(Ending ending, bool stopped) {
  ending.robot_stopped = stopped;
  if (stopped)
    ending.sight.motion = Sight::Motion::Still;
  return ending;
}

} // namespace

tl::expected<TetheredEnding, Failure> run_tethered(std::span<const Input> inputs,
                                                   const Options& given, Listener& listener,
                                                   report::Journey* journey,
                                                   protocol::Transport& transport,
                                                   const TetherOptions& tether) {
  // A report has lanes for all sensors.
  const auto streamed = journey == nullptr ? read_by(inputs) : Streamed{};
  Tether robot(transport, tether.robot, tether.budgets, streamed, tether.reopen);
  const auto first = robot.begin(tether.aim);
  if (!first)
    return tl::unexpected(first.error());
  Live* running = nullptr;
  const auto note = [&](auto what) {
    if (tether.recording != nullptr)
      tether.recording->lines.push_back({running == nullptr ? Duration{} : running->time(), what});
  };
  bool over = false; // later changes of the lamps are not the program's
  Witness witness(&robot, [&](std::string words) {
    if (!over)
      note(DriveLine::SentCommand{std::move(words)});
  });
  Tap tap(listener, [&](std::int32_t number) { note(DriveLine::Number{number}); });
  if (tether.recording != nullptr) {
    tether.recording->robot = tether.robot;
    tether.recording->first = *first;
  }
  auto options = given;
  options.model = tether.robot;
  options.robot = &witness;
  options.robot_sample = *first;
  const auto live = Live::start(inputs, options, tap, journey);
  if (!live) {
    robot.finish();
    return tl::unexpected(live.error());
  }
  running = live->get();
  if (tether.begins)
    tether.begins();
  if (robot.battery()) {
    note(*robot.battery());
    (*live)->apply(*robot.battery());
  }
  if (options.asks == Asks::Yes)
    (*live)->keep_waiting();
  Driven run(**live, robot, tap, tether);
  std::optional<Failure> failure;
  const auto driven = contain([&]() -> tl::expected<void, Failure> {
    for (auto course = run.step(); course != Driven::Progress::Ends; course = run.step())
      if (!course)
        return tl::unexpected(course.error());
    return {};
  });
  if (!driven)
    failure = driven.error();
  over = true;
  bool stopped = false;
  if (is_bug(failure)) {
    tap.close();
    stopped = robot.finish();
  } else {
    run.end();
    stopped = robot.finish(run.hear());
  }
  if (!failure)
    failure = robot.verdict();
  if (is_bug(failure))
    return TetheredEnding{
        finished((*live)->so_far(), stopped), std::move(failure), tether.robot, {}};
  tell_stop(tap, journey, (*live)->time(), stopped);
  auto ending = (*live)->finish();
  if (!ending)
    return tl::unexpected(ending.error());
  if (tether.recording != nullptr) {
    tether.recording->stopped = stopped;
    tether.recording->failure = failure;
  }
  return TetheredEnding{
      finished(*std::move(ending), stopped), std::move(failure), tether.robot, {}};
}

tl::expected<TetheredEnding, Failure> run_replayed(std::span<const Input> inputs,
                                                   const Options& given, Listener& listener,
                                                   report::Journey* journey,
                                                   const DriveRecording& recording) {
  Live* running = nullptr;
  std::string left;
  auto next = recording.lines.begin();
  const auto is_told = [](const DriveLine& line) {
    return std::holds_alternative<DriveLine::SentCommand>(line.what);
  };
  const auto differ = [&](const std::string& asked, const std::string& recorded) {
    if (!left.empty())
      return;
    const auto* first = first_with_program(inputs);
    const auto line = running == nullptr
                          ? 0
                          : static_cast<std::uint32_t>(running->ball().machine().asking_line());
    const auto where =
        first == nullptr || line == 0 ? std::string("the start") : first->program->where(line);
    left = fmt::format("the program departs from the recording at {}: it asks for {}, but "
                       "the recording has {}",
                       where, asked, recorded);
    if (running != nullptr)
      running->stop();
  };
  bool over = false;
  Witness witness(nullptr, [&](const std::string& words) {
    if (over)
      return;
    next = std::find_if(next, recording.lines.end(), is_told);
    const auto at = running == nullptr ? Duration{} : running->time();
    const auto said =
        next == recording.lines.end() ? std::string("nothing more") : drive_words(*next);
    if (const auto asked = drive_words({at, DriveLine::SentCommand{words}}); asked != said)
      differ(asked, said);
    if (next != recording.lines.end())
      ++next;
  });
  Tap tap(listener, {});
  auto options = given;
  options.model = recording.robot;
  options.robot = &witness;
  options.robot_sample = recording.first;
  const auto live = Live::start(inputs, options, tap, journey);
  if (!live)
    return tl::unexpected(live.error());
  running = live->get();
  for (const auto& [at, what] : recording.lines) {
    if (!left.empty())
      break;
    if (const auto* number = std::get_if<DriveLine::Number>(&what)) {
      running->wait(at);
      running->give(number->value);
    } else if (std::holds_alternative<DriveLine::Over>(what)) {
      running->advance(at);
      over = true;
    } else if (!is_told({at, what})) {
      if (!over)
        bring(*running, at);
      if (const auto* sample = std::get_if<vm::Sample>(&what))
        running->feel(*sample);
      else if (const auto* battery = std::get_if<vm::stimulus::Battery>(&what))
        running->apply(*battery);
      else
        running->feel(std::get<vm::event::Collision>(what));
    }
  }
  if (left.empty())
    if (const auto more = std::find_if(next, recording.lines.end(), is_told);
        more != recording.lines.end())
      left = fmt::format("the program ends before the recording, which has {} next",
                         drive_words(*more));
  tell_stop(tap, journey, running->time(), recording.stopped || !left.empty());
  auto ending = running->finish();
  if (!ending)
    return tl::unexpected(ending.error());
  return TetheredEnding{finished(*std::move(ending), recording.stopped), recording.failure,
                        recording.robot, std::move(left)};
}

} // namespace orb::run
