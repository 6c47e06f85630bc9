#include "base/contain.h"
#include "base/refuse.h"
#include "cli/commands/commands.h"
#include "cli/context/console.h"
#include "cli/robot/ball_profile.h"
#include "cli/robot/driven_robot.h"
#include "cli/terminal/confirm.h"
#include "cli/terminal/interrupt.h"
#include "disk/disk.h"
#include "run/calibrate/fit.h"
#include "run/tether/hold_robot.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::cli {
namespace {

struct CalibrateOptions {
  PortOptions port;
  std::string robot;
  std::string output; ///< name of the profile; empty for none
  std::string ball;   ///< profile that the robot of `sim:` drives by
  bool yes = false;
};

/// Announces the drive and waits for Enter.
tl::expected<void, Failure> ask(spec::Robot robot) {
  const auto time = std::chrono::round<std::chrono::seconds>(run::course_time()).count();
  print_err(fmt::format("the {} will drive by itself for up to {} s, within 2 m x 2 m\n"
                        "  put it in the middle of a clear, level floor, facing along one side\n",
                        spec::info(robot).title, time));
  return await_enter("`--yes` confirms that the floor is clear");
}

void print_result(const run::Calibration& found) {
  print_out(fmt::format("{:<13}{:>9}{:>12}\n", "", "model", "this one"));
  for (std::size_t row = 0; row < run::driving_rows.size(); ++row) {
    const auto& info = run::driving_rows[row];
    const auto spread = fmt::format("{:.2g}", found.spread[row]);
    print_out(fmt::format("{:<13}{:>9.4g}{:>12.4g} ± {}{}\n", info.name,
                          run::value_of(found.before, info), run::value_of(found.after, info),
                          info.unit.empty() ? spread : fmt::format("{:<7} {}", spread, info.unit),
                          found.open[row] ? "  not determined: this is the model's" : ""));
  }
  print_out(fmt::format(
      "position error {:.1f} cm with the model, {:.1f} cm with these numbers, over {} of {} legs\n",
      found.error_before_cm, found.error_after_cm, found.used, found.legs));
  print_out(fmt::format(
      "not measured: speeds below {} and above {}; for those the model's guess is kept\n",
      found.slowest, found.fastest));
}

tl::expected<void, Failure> save_profile(const Context& context, const std::string& name,
                                         const run::Profile& profile) {
  const auto file = profile_file(name);
  if (!file)
    return tl::unexpected(file.error());
  const auto folder = disk::as_path(*file).parent_path();
  if (std::error_code error; !folder.empty() && !std::filesystem::create_directories(folder, error))
    if (error)
      return refuse(ExitCode::File, fmt::format("cannot create the folder {}: {}", folder.string(),
                                                error.message()));
  if (const auto written = disk::write(*file, as_bytes(run::to_text(profile))); !written)
    return refuse(ExitCode::File, written.error().message);
  print_note(context, fmt::format("saved; `orb run --ball {}` drives like this robot", name));
  return {};
}

/// Stops the robot at the end, even after a failure.
tl::expected<std::vector<run::Leg>, Failure> drive_course(Context& context, DrivenRobot& robot) {
  auto held = run::hold_robot(*robot.link.transport, robot.tether);
  if (!held)
    return tl::unexpected(held.error());
  const bool shows = !context.quiet && is_terminal(Stream::Err);
  auto legs = contain([&] {
    return run::drive_course(**held, robot.tether.robot, [&](int done, int all) {
      if (shows)
        print_err(fmt::format("\r\033[K{} of {}{}", done, all, done == all ? "\n" : ""));
    });
  });
  const auto stopped = (*held)->hold();
  print_ended(context, stopped ? ExitCode::Done : ExitCode::LinkLost,
              stopped ? run::stop_done : run::stop_lost);
  if (legs && !stopped)
    return tl::unexpected(stopped.error());
  return legs;
}

/// Checks the options before anything moves. The virtual robot of `sim:` takes its numbers from
/// here.
tl::expected<void, Failure> check_given(CalibrateOptions& options) {
  if (!options.output.empty())
    if (const auto file = profile_file(options.output); !file)
      return tl::unexpected(file.error());
  if (options.ball.empty())
    return {};
  if (options.port.port != "sim:")
    return refuse(ExitCode::Usage, "`--ball` says how the virtual robot of `--port sim:` drives; "
                                   "omit it");
  const auto profile = read_profile(options.ball, options.robot);
  if (!profile)
    return tl::unexpected(profile.error());
  options.port.driving = profile->driving;
  options.robot = spec::info(profile->robot).name;
  return {};
}

tl::expected<void, Failure> calibrate(Context& context, CalibrateOptions options) {
  if (auto good = check_given(options); !good)
    return good;
  const InterruptGuard guard;
  auto connected = connect_robot(context, options.port, options.robot);
  if (!connected)
    return tl::unexpected(connected.error());
  const auto robot = (*connected)->tether.robot;
  if (!options.yes)
    if (auto asked = ask(robot); !asked)
      return asked;
  const auto legs = drive_course(context, **connected);
  if (!legs)
    return tl::unexpected(legs.error());
  const auto found = run::fit(*legs, robot);
  if (!found)
    return tl::unexpected(found.error());
  print_result(*found);
  if (!found->doubt.empty())
    return refuse(ExitCode::Refused, found->doubt);
  if (options.output.empty())
    return {};
  return save_profile(context, options.output,
                      {robot, found->after, found->slowest, found->fastest});
}

} // namespace

void add_calibrate(const Command& orb, Context& context) {
  const auto command = orb.add_command(
      "calibrate", "measure how a robot drives, for virtual balls that drive like it",
      "orb calibrate --port ble://SB-1A2B -o red\n"
      "orb calibrate --port @red -o red\n"
      "orb calibrate --port sim: --ball red --yes");
  auto options = std::make_shared<CalibrateOptions>();
  add_robot_port_options(command, options->port, options->robot);
  command.find("--port")->required();
  command
      .add_option("-o,--output", options->output,
                  "save the measured numbers under this name, or in a file such as ./red.toml")
      .type_name("NAME");
  command.add_flag("--yes", options->yes, "start driving at once: the floor is clear");
  add_ball_option(command, options->ball,
                  "how the virtual robot of `--port sim:` drives: a profile");
  command.callback([&context, options] {
    if (const auto done = calibrate(context, *options); !done)
      fail(context, done.error());
  });
}

} // namespace orb::cli
