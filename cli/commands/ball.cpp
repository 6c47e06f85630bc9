#include "base/text/text.h"
#include "cli/ball/served_judge.h"
#include "cli/ball/served_record.h"
#include "cli/commands/commands.h"
#include "cli/context/console.h"
#include "cli/context/language.h"
#include "cli/input/inputs.h"
#include "cli/model/checks.h"
#include "cli/robot/ball_profile.h"
#include "cli/run/run_console.h"
#include "serve/server.h"

#include "compiler/load.h"
#include "disk/disk.h"
#include "spec/firmware.h"
#include "spec/robots.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace orb::cli {
namespace {

/// The options of `orb ball`. Large because each of them is a field.
struct BallArguments {
  std::optional<std::string> pty;
  std::string tcp;
  std::optional<std::string> bluez;
  int count = 1;
  double speed = 1;
  std::uint64_t seed = 1;
  std::string firmware{spec::info(spec::default_firmware).name};
  std::string robot{spec::info(spec::Robot::Sphero).name};
  std::string profile;
  std::string fault;
  std::vector<std::string> stimuli;
  std::string course;
  std::string state;
  std::string log;
  bool control = false;
  std::string trace;
  std::string trace_out;
  std::string report;
  std::string judge;
};

/// A client's waits are accurate to about a millisecond. At a higher speed the ball would change
/// too much in that time for the client to follow (docs/using/ball.md has the measurement).
constexpr double greatest_speed = 10;

/// Checks the speed of a served ball's clock.
Check speeds() {
  auto check = number_between(0.001, greatest_speed);
  check.problem = [inside = check.problem](const std::string& text) {
    const auto speed = parse_real(text);
    if (!speed || !(*speed > greatest_speed) || !std::isfinite(*speed))
      return inside(text);
    return fmt::format(
        "at {0:g} a client cannot drive the ball: its waits are off by a millisecond "
        "or so, which is {0:g} ms of the ball's time; write `--speed {1:g}`, or use "
        "`orb run` and `orb test`, which do not wait at all",
        *speed, greatest_speed);
  };
  return check;
}

/// `HOST:PORT`, `:PORT` or `[V6]:PORT`.
std::optional<serve::ServeOptions::Tcp> parse_address(std::string_view text) {
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos)
    return std::nullopt;
  auto host = text.substr(0, colon);
  const auto digits = text.substr(colon + 1);
  const auto port = parse_number<std::uint16_t>(digits);
  if (!port)
    return std::nullopt;
  if (host.starts_with('[') && host.ends_with(']'))
    host = host.substr(1, host.size() - 2);
  return serve::ServeOptions::Tcp{host.empty() ? "127.0.0.1" : std::string(host), *port};
}

/// Writes the verdict in the format that the file extension names.
void write_judgement(Context& context, const JudgedLog& log, const std::string& file) {
  const auto say = say_in(context.ui_language);
  const bool to_stdout = file == "-";
  const auto text = has_ending(file, ".json") ? judged_json(log, say)
                    : has_ending(file, ".xml")
                        ? judged_junit(log)
                        : judged_text(log, to_stdout ? context.out_style() : Style{}, say);
  if (to_stdout)
    print_out(text);
  else if (const auto written = disk::write(file, as_bytes(text)); !written)
    return fail(context, {ExitCode::File, written.error().message});
  if (!log.is_clean() && context.exit == ExitCode::Done)
    context.exit = ExitCode::BadInput;
}

void run_ball(Context& context, const BallArguments& arguments) {
  serve::ServeOptions options;
  options.count = arguments.count;
  options.speed = arguments.speed;
  options.state_file = arguments.state;
  options.log_file = arguments.log;
  options.pty = arguments.pty.has_value() || (arguments.tcp.empty() && !arguments.bluez);
  options.pty_link = arguments.pty.value_or(bare_flag) == bare_flag ? "" : *arguments.pty;
  if (!arguments.tcp.empty()) {
    options.tcp = parse_address(arguments.tcp);
    if (!options.tcp)
      return fail(context,
                  {ExitCode::Usage, fmt::format("`{}` is not an address; write HOST:PORT such as "
                                                "127.0.0.1:4242",
                                                arguments.tcp)});
  }
  const auto& firmware = *spec::find_firmware(arguments.firmware); // the option has been checked
  options.robot = spec::find_robot(arguments.robot)->robot;        // the option has been checked
  options.ball.driving = spec::driving(options.robot);
  if (!arguments.profile.empty()) {
    const bool named = options.robot != spec::Robot::Sphero;
    const auto profile = read_profile(arguments.profile, named ? arguments.robot : "");
    if (!profile)
      return fail(context, profile.error());
    options.robot = profile->robot;
    options.ball.driving = profile->driving;
  }
  options.ball.robot = options.robot;
  const bool is_v2 = spec::info(options.robot).packets == spec::Packets::V2;
  if (is_v2 && !arguments.state.empty())
    return fail(context, {ExitCode::Usage, fmt::format("a {} stores no programs or settings; "
                                                       "omit `--state`",
                                                       spec::info(options.robot).title)});
  options.ball.seed = arguments.seed;
  options.ball.firmware = firmware.firmware;
  options.ball.ram_bytes = firmware.ram_bytes();
  options.ball.loader = compiler::load;
  if (!arguments.fault.empty()) {
    const auto plan = protocol::parse_fault_plan(arguments.fault);
    if (!plan)
      return fail(context, {ExitCode::Usage, plan.error()});
    options.fault = *plan;
  }
  if (arguments.bluez) {
    options.bluez.emplace();
    if (*arguments.bluez != bare_flag) {
      const auto plan = protocol::parse_ble_fault_plan(*arguments.bluez);
      if (!plan)
        return fail(context, {ExitCode::Usage, plan.error()});
      options.bluez = *plan;
    }
  }
  auto stimulus = read_stimuli(context, arguments.stimuli);
  if (!stimulus)
    return fail(context, stimulus.error());
  options.stimulus = *std::move(stimulus);
  RecordOptions record_options{
      options.count,       options.robot,    trace_format(arguments.trace, arguments.trace_out),
      arguments.trace_out, arguments.report, std::nullopt,
      options.stimulus};
  if (!arguments.course.empty()) {
    const auto course = read_course(context, arguments.course);
    if (!course)
      return fail(context, course.error());
    const auto walls = course->stimuli();
    options.stimulus.insert(options.stimulus.begin(), walls.begin(), walls.end());
    record_options.course = *course;
  }
  const bool has_data_out = (record_options.trace && arguments.trace_out.empty()) ||
                            arguments.report == "-" || arguments.judge == "-";
  std::optional<ServedJudge> judge;
  if (!arguments.judge.empty()) {
    judge.emplace(options.count, options.robot);
    options.hear = [&](int index) { return judge->hear(index); };
  }
  ServedRecord record(std::move(record_options));
  if (const auto opened = record.open(); !opened)
    return fail(context, {ExitCode::File, opened.error().message});
  options.watch = [&](int index) { return record.watch(index); };
  options.announce = options.answer = has_data_out ? print_err : print_out;
  if (arguments.control)
    options.control = read_input;
  options.note = [&context](std::string_view message) { print_note(context, message); };
  options.warn = [&context](std::string_view message) { print_warning(context, message); };
  const auto served = serve::serve(options);
  const auto recorded = record.finish();
  if (!served)
    fail(context, served.error());
  else if (record.lost())
    throw *record.lost();
  else if (!recorded)
    fail(context, {ExitCode::File, recorded.error().message});
  if (judge)
    write_judgement(context, judge->finish(), arguments.judge);
}

} // namespace

void add_ball(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("ball", "serve virtual balls that real clients can connect to",
                      "orb ball\norb ball --tcp 127.0.0.1:4242\n"
                      "orb ball --pty=/tmp/sphero --state ball.state --log session.txt\n"
                      "orb ball --tcp :0 --fault drop=1%,flip=0.1%,seed=7\n"
                      "orb ball --bluez=pieces=1..20,drop-once@services\n"
                      "orb ball --robot bolt --tcp :4242\n"
                      "orb ball --tcp :4242 --trace json --report drive.html\n"
                      "orb ball --robot bolt --tcp :4242 --judge client.xml\n"
                      "printf 'at 2s shake\\n' | orb ball --tcp :4242 --control");
  auto arguments = std::make_shared<BallArguments>();
  // A flag rather than an option: a flag takes a value only after `=`.
  command
      .add_flag("--pty", arguments->pty,
                "serve on a pty (the default without --tcp); =LINK also creates a symlink to it")
      .type_name("LINK");
  command
      .add_flag("--bluez", arguments->bluez,
                "serve over a simulated Bluetooth LE adapter, on a private D-Bus; =PLAN injects "
                "faults: pieces=1..20,late=2s,drop@services,lose=1%")
      .type_name("PLAN");
  command.add_option("--tcp", arguments->tcp, "serve on HOST:PORT; port 0 picks a free one")
      .type_name("HOST:PORT");
  command
      .add_option("--count", arguments->count,
                  "how many balls; ports count up, links and files get -1, -2, …")
      .check(whole_number(1, 1000))
      .show_default();
  command
      .add_option("--speed", arguments->speed,
                  "how many seconds pass on the ball in one real second")
      .check(speeds())
      .show_default();
  command
      .add_option("--seed", arguments->seed,
                  "the seed of all random choices; the address depends on it, too")
      .check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      .show_default();
  command.add_option("--firmware", arguments->firmware, "the firmware that the ball runs")
      .check(one_of(names_of(spec::firmwares)))
      .show_default();
  command
      .add_option("--robot", arguments->robot,
                  "which robot to be; those after SPRK+ use v2 packets")
      .check(one_of(names_of(spec::robots)))
      .show_default();
  add_ball_option(command, arguments->profile,
                  "how it drives: a profile from `orb calibrate`, by name or file");
  command
      .add_option(
          "--fault", arguments->fault,
          "simulate a bad link: drop=1%,flip=0.1%,dup=1%,delay=50..300ms,split,cut@1234,seed=7")
      .type_name("PLAN");
  add_stimulus_option(command, arguments->stimuli);
  add_course_option(command, arguments->course);
  command.add_option("--state", arguments->state, "keep flash and settings across runs")
      .type_name("FILE");
  command
      .add_option("--log", arguments->log,
                  "record every byte, and when it passed, in the form that `replay://` reads")
      .type_name("FILE");
  command
      .add_option("--trace", arguments->trace, "one event per line, as `orb run --trace` has them")
      .check(one_of({"json", "csv"}));
  command.add_option("--trace-out", arguments->trace_out, "the file for the trace");
  command.add_option("--report", arguments->report,
                     "write a page at the end that plays everything back");
  command
      .add_option("--judge", arguments->judge,
                  "says at the end what the clients did wrong, and then ends with code 1; .json, "
                  "or .xml for JUnit")
      .type_name("FILE");
  command.add_flag("--control", arguments->control,
                   "obey lines of standard input: stimuli such as `shake` or `at 5s push 90 120`, "
                   "`reset`, `state`; with several balls `2 shake` is for the second, others for "
                   "all");
  command.callback([&context, arguments] { run_ball(context, *arguments); });
}

} // namespace orb::cli
