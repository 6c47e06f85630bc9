#include "cli/run/on_robot.h"

#include "base/refuse.h"
#include "cli/robot/driven_robot.h"
#include "cli/robot/reach.h"
#include "cli/terminal/interrupt.h"
#include "compiler/lint/lint.h"
#include "disk/disk.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <set>

namespace orb::cli {
namespace {

/// Lists words in the program that this robot does not support, each once.
void hint_at_lacks(const Context& context, const std::vector<run::Input>& inputs,
                   spec::Robot robot) {
  std::set<std::string> said;
  for (const auto& input : inputs)
    if (input.program)
      for (const auto& found : compiler::robot_findings(input.program->parsed, robot))
        if (said.insert(in_english(found.message)).second)
          print_note(context, "hint: " + in_english(found.message));
}

bool is_number(const vm::TimedStimulus& event) {
  return std::holds_alternative<vm::stimulus::Number>(event.stimulus);
}

/// The stimuli for a virtual robot, without inputs: those go to the program, which runs here.
std::vector<vm::TimedStimulus> world_of(const run::Options& options) {
  auto events =
      options.course != nullptr ? options.course->stimuli() : std::vector<vm::TimedStimulus>();
  std::copy_if(options.stimuli.begin(), options.stimuli.end(), std::back_inserter(events),
               [](const vm::TimedStimulus& event) { return !is_number(event); });
  return events;
}

} // namespace

bool drives_virtual(const Context& context, const RunOptions& given) {
  if (given.port.port.empty() || !given.replay.empty())
    return false;
  const auto endpoint = find_endpoint(context.config, given.port.port);
  return endpoint && endpoint->scheme == uploader::Scheme::Sim;
}

tl::expected<void, Failure> check_for_robot(const Context& context, const RunOptions& given,
                                            const run::Options& options) {
  const auto of_simulation = [&](std::string_view option) {
    return refuse(ExitCode::Usage,
                  fmt::format("`{}` is for the virtual ball; omit it, or omit `{}`", option,
                              given.replay.empty() ? "--port" : "--replay"));
  };
  const bool has_world = drives_virtual(context, given);
  if (!given.course.empty() && !has_world)
    return of_simulation("--course");
  if (given.firmware_given)
    return of_simulation("--firmware");
  if (given.disconnected)
    return of_simulation("--disconnected");
  if (!has_world && !std::all_of(options.stimuli.begin(), options.stimuli.end(), is_number))
    return refuse(ExitCode::Usage,
                  fmt::format("with a robot, a stimulus can only be an `input`: shake and push the "
                              "robot by hand, or omit `{}`",
                              given.replay.empty() ? "--port" : "--replay"));
  return {};
}

tl::expected<OnRobot, Failure> run_on_robot(const Context& context, const RunOptions& given,
                                            const run::Options& given_options,
                                            const std::vector<run::Input>& inputs, Console& console,
                                            report::Journey* journey) {
  std::optional<disk::Draft> record;
  if (!given.record.empty()) { // report unwritable files before anything moves
    auto draft = disk::Draft::of(given.record);
    if (!draft)
      return tl::unexpected(Failure{ExitCode::File, draft.error().message});
    record = *std::move(draft);
  }
  const InterruptGuard guard;
  auto connected = connect_robot(context, given.port, given.robot);
  if (!connected)
    return tl::unexpected(connected.error());
  auto& robot = **connected;
  hint_at_lacks(context, inputs, robot.tether.robot);
  robot.tether.aim = given.keep_aim ? run::Aim::Keep : run::Aim::Zero;
  auto options = given_options;
  if (robot.link.ball != nullptr) {
    robot.tether.begins = [&ball = *robot.link.ball, world = world_of(options)] {
      ball.schedule(world);
    };
    std::erase_if(options.stimuli,
                  [](const vm::TimedStimulus& event) { return !is_number(event); });
  }
  run::DriveRecording recording;
  if (record)
    robot.tether.recording = &recording;
  console.outlive_output([&robot] { robot.link.stopper->interrupt(); });
  auto driven =
      run::run_tethered(inputs, options, console, journey, *robot.link.transport, robot.tether);
  console.outlive_output([] {}); // print the rest without the robot
  if (!driven)
    return tl::unexpected(name_robot(robot.link, given.robot, driven.error()));
  if (driven->failure)
    driven->failure = name_robot(robot.link, given.robot, *driven->failure);
  OnRobot ended{*std::move(driven)};
  if (given.sleeps)
    ended.slept = ended.driven.failure && ended.driven.failure->code == ExitCode::LinkLost
                      ? left_awake()
                      : put_to_sleep(*robot.link.transport, robot.tether.robot, robot.link);
  if (!record)
    return ended;
  record->append(as_bytes(run::to_text(recording)));
  if (auto written = record->publish(); !written && !ended.driven.failure)
    ended.driven.failure = Failure{ExitCode::File, written.error().message};
  return ended;
}

tl::expected<OnRobot, Failure> replay_drive(const RunOptions& given, const run::Options& options,
                                            const std::vector<run::Input>& inputs, Console& console,
                                            report::Journey* journey) {
  const auto text = disk::read(given.replay);
  if (!text)
    return tl::unexpected(Failure{ExitCode::File, text.error().message});
  const auto recording = run::parse_drive_recording(*text);
  if (!recording)
    return tl::unexpected(Failure{ExitCode::BadInput, fmt::format("{} cannot be replayed: {}",
                                                                  disk::display_name(given.replay),
                                                                  recording.error())});
  auto driven = run::run_replayed(inputs, options, console, journey, *recording);
  if (!driven)
    return tl::unexpected(driven.error());
  return OnRobot{*std::move(driven)};
}

std::string_view stop_note(const run::Ending& ending) {
  return ending.robot_stopped.value_or(false) ? run::stop_done : run::stop_lost;
}

} // namespace orb::cli
