#include "cli/on_robot.h"

#include "cli/terminal/interrupt.h"
#include "disk/disk.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::cli {
namespace {

tl::unexpected<Failure> refuse(std::string message) {
  return tl::unexpected(Failure{ExitCode::Usage, std::move(message)});
}

constexpr Duration patience = 6s; // for a robot to say what it is

} // namespace

tl::expected<void, Failure> check_for_robot(const RunOptions& given, const run::Options& options) {
  const auto of_simulation = [&](std::string_view option) {
    return refuse(fmt::format("`{}` is for the virtual ball; leave it out, or leave `{}` out",
                              option, given.replay.empty() ? "--port" : "--replay"));
  };
  if (!given.course.empty())
    return of_simulation("--course");
  if (given.firmware_given)
    return of_simulation("--firmware");
  if (given.disconnected)
    return of_simulation("--disconnected");
  for (const auto& event : options.stimuli)
    if (!std::holds_alternative<vm::stimulus::Number>(event.stimulus))
      return refuse("with a robot a stimulus can only be an `input`: shake and push it by hand, or "
                    "leave `--port` out");
  return {};
}

tl::expected<run::TetheredEnding, Failure>
run_on_robot(const Context& context, const RunOptions& given, const run::Options& options,
             const std::vector<run::Input>& inputs, Console& console, report::Journey* journey) {
  std::optional<disk::Draft> record;
  if (!given.record.empty()) { // what cannot be written is told before anything moves
    auto draft = disk::Draft::of(given.record);
    if (!draft)
      return tl::unexpected(Failure{ExitCode::File, draft.error().message});
    record = *std::move(draft);
  }
  const InterruptGuard guard;
  auto port = given.port;
  port.robot = options.model;
  port.accepts = uploader::Accepts::All;
  auto link = open_link(context, port);
  if (!link)
    return tl::unexpected(link.error());
  run::TetherOptions tether;
  tether.aim = given.keep_aim ? run::Aim::Keep : run::Aim::Zero;
  tether.note = [&](const std::string& message) { print_note(context, message); };
  std::unique_ptr<Link> second;
  if (!link->is_sim)
    tether.reopen = [&]() -> std::unique_ptr<protocol::Transport> {
      auto opened = open_link(context, port);
      if (!opened)
        return nullptr;
      second = std::make_unique<Link>(*std::move(opened));
      return std::move(second->transport);
    };
  if (!given.robot.empty() || link->is_sim)
    tether.robot = options.model;
  else if (link->named)
    tether.robot = *link->named;
  else if (const auto found = run::find_robot(*link->transport, patience))
    tether.robot = *found;
  else
    return tl::unexpected(found.error());
  run::DriveRecording recording;
  if (record)
    tether.recording = &recording;
  auto driven = run::run_tethered(inputs, options, console, journey, *link->transport, tether);
  if (!driven || !record)
    return driven;
  record->append(as_bytes(run::to_text(recording)));
  if (auto written = record->publish(); !written && !driven->failure)
    driven->failure = Failure{ExitCode::File, written.error().message};
  return driven;
}

tl::expected<run::TetheredEnding, Failure>
replay_drive(const RunOptions& given, const run::Options& options,
             const std::vector<run::Input>& inputs, Console& console, report::Journey* journey) {
  const auto text = disk::read(given.replay);
  if (!text)
    return tl::unexpected(Failure{ExitCode::File, text.error().message});
  const auto recording = run::parse_drive_recording(*text);
  if (!recording)
    return tl::unexpected(Failure{ExitCode::BadInput, fmt::format("{} cannot be replayed: {}",
                                                                  disk::display_name(given.replay),
                                                                  recording.error())});
  return run::run_replayed(inputs, options, console, journey, *recording);
}

std::string_view stop_note(const run::Ending& ending) {
  return ending.robot_stopped.value_or(false)
             ? "the robot has been stopped"
             : "the robot has not acknowledged the stop; by itself it stops 2 s after the last "
               "command: see that it does";
}

} // namespace orb::cli
