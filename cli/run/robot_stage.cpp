#include "cli/run/robot_stage.h"

#include "cli/run/on_robot.h"
#include "cli/terminal/confirm.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace orb::cli {
namespace {

/// Who performs a stimulus for a real robot.
enum class Doer : std::uint8_t { Program, Hand, Nobody };

Doer doer_of(const vm::Stimulus& stimulus) {
  struct {
    Doer operator()(const vm::stimulus::Number&) const { return Doer::Program; }
    Doer operator()(const vm::Wall&) const { return Doer::Hand; }
    Doer operator()(const vm::stimulus::Shake&) const { return Doer::Hand; }
    Doer operator()(const vm::stimulus::Toss&) const { return Doer::Hand; }
    Doer operator()(const vm::stimulus::Push&) const { return Doer::Hand; }
    Doer operator()(const vm::stimulus::Tilt&) const { return Doer::Hand; }
    Doer operator()(const vm::stimulus::Spin&) const { return Doer::Hand; }
    Doer operator()(const vm::stimulus::ClientRoll&) const { return Doer::Nobody; }
    Doer operator()(const vm::stimulus::ClientColor&) const { return Doer::Nobody; }
    Doer operator()(const vm::stimulus::Connect&) const { return Doer::Nobody; }
    Doer operator()(const vm::stimulus::Disconnect&) const { return Doer::Nobody; }
    Doer operator()(const vm::stimulus::Battery&) const { return Doer::Nobody; }
    Doer operator()(const vm::stimulus::Charger&) const { return Doer::Nobody; }
    Doer operator()(const vm::stimulus::Noise&) const { return Doer::Nobody; }
  } const doer;
  return std::visit(doer, stimulus);
}

bool has(const run::Options& options, Doer doer) {
  return std::any_of(options.stimuli.begin(), options.stimuli.end(),
                     [&](const vm::TimedStimulus& one) { return doer_of(one.stimulus) == doer; });
}

Failure cannot(std::string message) {
  return {ExitCode::Usage, std::move(message)};
}

} // namespace

/// Says what to do by hand, and waits for Enter.
tl::expected<void, Failure> RobotStage::await_hands(const testing::Suite& suite,
                                                    const testing::Group& group,
                                                    const run::Options& options, run::Home home) {
  const auto& test = suite.test_of(group);
  print_err(fmt::format("case {} of {}: {}, {}, seed {}\n", begun_, cases_, test.name.text,
                        suite.programs[group.program].name, options.seed));
  if (begun_ == 1 || home == run::Home::Missed)
    print_err("  put the robot on its mark, facing the way it should start\n");
  if (options.course != nullptr && !options.course->walls.empty())
    print_err(
        fmt::format("  the walls of the course {} should be around it\n", options.course->name));
  if (has(options, Doer::Hand)) {
    print_err("  after the start, by hand:\n");
    for (const auto& line : test.stimulus_lines)
      print_err(fmt::format("    {}\n", line));
  }
  return await_enter("`--yes` confirms that the robot is on its mark for every test");
}

tl::expected<void, Failure> RobotStage::ready(const testing::Suite& suite,
                                              const testing::Group& group,
                                              const run::Options& options) {
  if (has(options, Doer::Nobody))
    return tl::unexpected(cannot("the test makes something happen that only the virtual ball can "
                                 "do; run it without `--port`"));
  if (attended_ == Attended::No && has(options, Doer::Hand))
    return tl::unexpected(
        cannot("the test needs someone to shake or push the robot; omit `--yes`"));
  auto home = run::Home::Reached;
  if (begun_++ > 0) {
    auto came = run::drive_home(*robot_.link.transport, robot_.tether);
    if (!came) {
      broken_ = came.error();
      return tl::unexpected(came.error());
    }
    home = *came;
  }
  if (attended_ == Attended::Yes) {
    if (auto begins = await_hands(suite, group, options, home); !begins) {
      broken_ = begins.error();
      return begins;
    }
    robot_.tether.aim = run::Aim::Zero;
    return {};
  }
  if (home == run::Home::Missed) {
    broken_ = Failure{
        ExitCode::Refused,
        "the robot did not find its way back to its mark: something is in its way, or it slips"};
    return tl::unexpected(*broken_);
  }
  // The mark is where it was first placed, not where it came to rest.
  robot_.tether.aim = begun_ == 1 ? run::Aim::Zero : run::Aim::Keep;
  return {};
}

tl::expected<run::Ending, Failure>
RobotStage::play(const testing::Suite& suite, const testing::Group& group,
                 const run::Options& given, run::Listener& listener, report::Journey& journey) {
  if (broken_)
    return tl::unexpected(Failure{broken_->code, "not run: " + broken_->message});
  if (auto begins = ready(suite, group, given); !begins)
    return tl::unexpected(begins.error());
  auto options = given;
  std::erase_if(options.stimuli, [](const vm::TimedStimulus& one) {
    return doer_of(one.stimulus) != Doer::Program;
  });
  options.model = robot_.tether.robot;
  auto driven = run::run_tethered(suite.programs[group.program].inputs, options, listener, &journey,
                                  *robot_.link.transport, robot_.tether);
  auto failure = driven ? driven->failure : std::optional(driven.error());
  if (failure) {
    if (driven && !driven->ending.robot_stopped.value_or(true))
      failure->message += fmt::format("; {}", stop_note(driven->ending));
    broken_ = failure;
    return tl::unexpected(*failure);
  }
  if (!driven->ending.robot_stopped.value_or(true)) {
    broken_ = Failure{ExitCode::LinkLost, std::string(stop_note(driven->ending))};
    return tl::unexpected(*broken_);
  }
  return std::move(driven->ending);
}

} // namespace orb::cli
