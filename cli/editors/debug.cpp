#include "cli/context/console.h"
#include "cli/editors/commands.h"
#include "cli/input/inputs.h"
#include "cli/model/checks.h"
#include "cli/robot/ball_profile.h"
#include "cli/robot/driven_robot.h"
#include "cli/terminal/interrupt.h"
#include "debug/launch.h"
#include "debug/shell.h"
#include "disk/disk.h"

#include <fmt/format.h>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <unistd.h>

namespace orb::cli {
namespace {

struct DebugOptions {
  debug::Launch launch;
  std::uint64_t seed = 1;
  std::vector<std::string> commands;
  bool disconnected = false;
  bool plain = false;
  bool optimized = false;
  std::string ball; ///< a profile; empty for none
  PortOptions port; ///< of a robot; empty for the virtual ball
  std::string robot;
};

class Terminal final : public debug::Console {
public:
  void print(std::string_view text) override { print_out(text); }
  void say(std::string_view text) override { print_out(fmt::format("{}\n", text)); }
};

tl::expected<void, std::string> write_file(const std::string& name, std::string_view text) {
  auto written = disk::write(name, as_bytes(text));
  if (!written)
    return tl::unexpected(written.error().message);
  return {};
}

void obey(debug::Shell& shell, const std::string& line) {
  const InterruptGuard guard; // Ctrl-C stops the program, not the debugger
  shell.obey(line, [] { return InterruptGuard::asked(); });
}

ExitCode converse(debug::Shell& shell, const std::vector<std::string>& commands) {
  constexpr std::string_view prompt = "(orb) ";
  for (const auto& line : commands) {
    print_out(fmt::format("{}{}\n", prompt, line));
    obey(shell, line);
  }
  const bool terminal = is_terminal(Stream::In);
  while (!shell.done()) {
    if (terminal)
      print_out(prompt);
    std::string line;
    if (!std::getline(std::cin, line))
      break;
    if (!terminal) // echoes input as a terminal would
      print_out(fmt::format("{}{}\n", prompt, line));
    obey(shell, line);
  }
  return ExitCode::Done;
}

/// A failure may hold several errors: prints one per line.
void fail_by_line(Context& context, const Failure& failure) {
  std::string_view rest = failure.message;
  for (auto end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    fail(context, {failure.code, std::string(rest.substr(0, end))});
    rest.remove_prefix(end + 1);
  }
  fail(context, {failure.code, std::string(rest)});
}

tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
robot_for(const Context& context, const debug::Launched& launched, const DebugOptions& options) {
  if (auto fits = debug::check_for_robot(launched); !fits)
    return tl::unexpected(fits.error());
  return hold_robot(context, options.port, options.robot);
}

/// Translates the options; fails for combinations that do not go together.
tl::expected<debug::Launch, Failure> launch_of(const DebugOptions& options) {
  const auto refuse = [](std::string_view message) {
    return tl::unexpected(Failure{ExitCode::Usage, std::string(message)});
  };
  auto launch = options.launch;
  if (launch.files.empty() && launch.test.empty())
    return refuse("name a program, or a test file with `--test`");
  if (!launch.test_name.empty() && launch.test.empty())
    return refuse("`--only` needs `--test`: it names a test in that file");
  if (!launch.test.empty() && (!launch.course.empty() || !launch.stimuli.empty()))
    return refuse("`--test` brings its own course and stimuli; omit `--course` and "
                  "`--stimulus`");
  if (!options.ball.empty() && !options.port.port.empty())
    return refuse("`--ball` says how a virtual ball drives; omit it, or omit `--port`");
  if (!options.ball.empty()) {
    const auto profile = read_profile(options.ball, {});
    if (!profile)
      return tl::unexpected(profile.error());
    launch.profile = *profile;
  }
  launch.seed = options.seed;
  if (options.disconnected)
    launch.client = run::Client::Absent;
  if (options.plain || options.optimized)
    launch.shape = options.plain ? structured::Shape::Steppable : structured::Shape::Shortest;
  return launch;
}

void debug_it(Context& context, const DebugOptions& options) {
  const auto launch = launch_of(options);
  if (!launch)
    return fail(context, launch.error());
  DiskFiles files;
  const auto launched = debug::read(*launch, files);
  if (!launched)
    return fail_by_line(context, launched.error());
  std::optional<InterruptGuard> guard; // the robot is restored on every way out
  std::shared_ptr<run::HeldRobot> robot;
  if (!options.port.port.empty()) {
    guard.emplace();
    auto opened = robot_for(context, **launched, options);
    if (!opened)
      return fail(context, opened.error());
    robot = *std::move(opened);
  }
  Terminal terminal;
  const auto debugger =
      debug::Debugger::start((*launched)->inputs, (*launched)->options, terminal, robot.get());
  if (!debugger)
    return fail(context, debugger.error());
  debug::Shell shell(**debugger, terminal, write_file);
  shell.show_place();
  context.exit = converse(shell, options.commands);
  if (const auto& lost = (*debugger)->timeline().lost())
    context.exit = lost->code;
}

} // namespace

void add_debug(const Command& orb, Context& context) {
  const auto command = orb.add_command(
      "debug", "run a program line by line on a virtual ball, forwards and backwards",
      "orb debug patrol.orb\n"
      "orb debug square.bas --stimulus \"at 2s shake\"\n"
      "orb debug --test corner.test --only \"stops at the wall\"\n"
      "orb debug square.bas --port ble://SB-1A2B\n"
      "orb debug square.bas --do \"b 40\" --do c --do \"p X\"");
  auto options = std::make_shared<DebugOptions>();
  auto& launch = options->launch;
  command.add_option("FILE", launch.files, "a program, and any macros to load with it");
  add_language_option(command, launch.language);
  add_stimulus_option(command, launch.stimuli);
  add_course_option(command, launch.course);
  command.add_option("--test", launch.test, "a test file, whose course and stimuli are used")
      .type_name("FILE.test");
  command.add_option("--only", launch.test_name, "the name of the test in that file")
      .type_name("NAME");
  command.add_option("--seed", options->seed, "the seed of the random numbers")
      .check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      .show_default();
  command.add_option("--input", launch.numbers, "numbers for `input`").separated_by(',');
  command.add_flag("--disconnected", options->disconnected, "run with no client connected");
  const auto plain =
      command.add_flag("--plain", options->plain,
                       "each statement keeps its own lines (the default without `--test`)");
  command
      .add_flag("--optimized", options->optimized,
                "the lines as sent to a robot; one line may stand for several statements")
      .excludes(plain);
  add_ball_option(command, options->ball,
                  "the virtual ball drives like the robot that `orb calibrate` measured");
  add_robot_port_options(command, options->port, options->robot);
  command.add_option("--do", options->commands, "a command to run first; can be repeated")
      .one_value_each()
      .type_name("COMMAND");
  command.callback([&context, options] { debug_it(context, *options); });
}

} // namespace orb::cli
