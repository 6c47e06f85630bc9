#include "run/run.h"
#include "base/refuse.h"
#include "cli/commands/commands.h"
#include "cli/commands/robot/monitor.h"
#include "cli/context/console.h"
#include "cli/input/inputs.h"
#include "cli/input/target.h"
#include "cli/model/checks.h"
#include "cli/robot/ball_profile.h"
#include "cli/room/room_plan.h"
#include "cli/room/run_together.h"
#include "cli/run/on_robot.h"
#include "cli/run/run_console.h"
#include "cli/run/run_options.h"
#include "cli/run/run_robots.h"
#include "cli/terminal/browser.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/watch.h"
#include "disk/disk.h"
#include "report/page.h"
#include "report/reload.h"
#include "report/svg.h"
#include "run/want.h"
#include "run/why.h"
#include "spec/firmware.h"
#include "structured/text/structured_words.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <unistd.h>

namespace orb::cli {

namespace {

/// Reads the profile that virtual balls drive by, also for `sim:`.
tl::expected<std::optional<run::Profile>, Failure> take_profile(RunOptions& given) {
  if (given.ball.empty())
    return std::nullopt;
  const auto profile = read_profile(given.ball, given.robot);
  if (!profile)
    return tl::unexpected(profile.error());
  given.port.driving = profile->driving;
  if (given.port.port == "sim:")
    given.robot = spec::info(profile->robot).name;
  return *profile;
}

/// Notes that nobody has measured this robot at these speeds.
void hint_at_guesses(const Context& context, const RunOptions& given, const run::Profile& profile,
                     const Console& console) {
  const auto& [slowest, fastest] = console.speeds();
  if (fastest > profile.fastest || slowest < profile.slowest)
    print_note(context, fmt::format("hint: it drove at {0}; `{1}` was measured from {2} to {3}; "
                                    "beyond that its path is a guess",
                                    fastest > profile.fastest ? fastest : slowest, given.ball,
                                    profile.slowest, profile.fastest));
}

/// Reads the run to compare with from a page; empty if none is given.
tl::expected<std::string, Failure> read_before(const RunOptions& options) {
  if (options.compare.empty())
    return std::string();
  const auto page = disk::read(options.compare);
  if (!page)
    return refuse(ExitCode::File, page.error().message);
  auto run = report::run_of_page(*page);
  if (!run)
    return refuse(ExitCode::Usage, fmt::format("{} is not a page from `orb run --report`",
                                               disk::display_name(options.compare)));
  return *std::move(run);
}

tl::expected<void, IoError> write_pictures(const RunOptions& options,
                                           const report::Journey& journey,
                                           const report::Journey* planned,
                                           std::string_view before) {
  if (!options.report.empty()) {
    auto page = report::report_page(journey, disk::display_name(options.files.front()), before,
                                    structured::keyword_words);
    if (options.watch)
      page = report::reloading(std::move(page));
    if (auto done = disk::write(options.report, as_bytes(page)); !done)
      return done;
  }
  return options.svg.empty()
             ? tl::expected<void, IoError>()
             : disk::write(options.svg, as_bytes(report::path_svg(journey, planned)));
}

/// Where to look at the run, or how to record one; empty if there is nothing to see.
std::string where_to_look(const RunOptions& options, const run::Sight& sight) {
  if (options.open || (sight.way_cm == 0 && !sight.turned && !sight.color))
    return "";
  return fmt::format("; {} shows it", options.report.empty() ? "--open" : options.report);
}

void tell_end(const Context& context, const RunOptions& options, const run::Ending& ending,
              const std::string& why) {
  const auto story = run::story(ending);
  if (!story.empty())
    print_note(context, story + where_to_look(options, ending.sight));
  if (!why.empty())
    print_note(context, "why: " + why);
  print_note(context, run::to_string(ending));
}

/// Judges the run by its output, if the user asked for that.
tl::expected<void, Failure> judge(const RunOptions& options, const run::Ending& ending) {
  if (ending.seen == run::Sought::Forbidden)
    return refuse(ExitCode::BadInput,
                  fmt::format("the program printed `{}`", options.run.fail_text));
  if (!options.run.expect.empty() && ending.seen != run::Sought::Expected)
    return refuse(ExitCode::BadInput,
                  fmt::format("the program never printed `{}`", options.run.expect));
  return {};
}

/// Tells `perf report` which lines the machine code of this process comes from, in its format:
/// /tmp/perf-PID.map, lines of `START SIZE NAME` with hexadecimal numbers.
void write_perf_map(const Context& context, std::span<const vm::NativeCode::Piece> pieces) {
  if (std::getenv("ORB_PERF_MAP") == nullptr || pieces.empty())
    return;
  std::string text;
  for (const auto& piece : pieces)
    text += fmt::format("{:x} {:x} orbBasic {}\n", reinterpret_cast<std::uintptr_t>(piece.address),
                        piece.size,
                        piece.line == 0 ? "entry and exit" : fmt::format("line {}", piece.line));
  const auto path = fmt::format("/tmp/perf-{}.map", getpid());
  if (const auto written = disk::write(path, as_bytes(text)); !written)
    // perf then shows addresses; the run itself is fine
    print_note(context, written.error().message);
}

/// Opens the report. A failure here does not change the result of the run.
void show(const Context& context, const RunOptions& options) {
  if (const auto shown = show_in_browser(options.report); !shown)
    print_error(context, shown.error());
}

/// A name for a report without one, in a new folder. The folder is kept, because the browser reads
/// from it.
tl::expected<std::string, Failure> temporary_report(const std::string& program) {
  const auto own = make_temporary_folder();
  if (!own) {
    std::error_code ignored;
    const auto folder = std::filesystem::temp_directory_path(ignored);
    return refuse(ExitCode::File, fmt::format("cannot create a folder for the report in {}; name a "
                                              "file with `--report`",
                                              folder.empty() ? "/tmp" : folder.string()));
  }
  const auto name = program == "-" ? "run" : disk::as_path(program).stem().string();
  return fmt::format("{}/{}.html", *own, name);
}

/// Reads the course, if given, into `course`; the options refer to it afterwards.
tl::expected<void, Failure> take_course(const Context& context, const std::string& path,
                                        std::optional<report::Course>& course,
                                        run::Options& options) {
  if (path.empty())
    return {};
  auto read = read_course(context, path);
  if (!read)
    return tl::unexpected(read.error());
  course = *std::move(read);
  options.course = &*course;
  return {};
}

/// Simulates the same run on a virtual ball of that model.
void plan(const std::vector<run::Input>& inputs, const run::Options& given, spec::Robot robot,
          report::Journey& journey) {
  class Nobody final : public run::Listener {
    void on_event(Duration, const vm::Event&) override {}
    void on_fault(Duration, const run::ProgramError&) override {}
  } nobody;
  auto options = given;
  if (options.model != robot) // the profile was measured on another model
    options.driving.reset();
  options.model = robot;
  // without a result there is no plan
  static_cast<void>(run::run(inputs, options, nobody, &journey));
}

/// Hints at inputs or stimuli that the program waits for, with the option that provides them; empty
/// if no option can, as with a real robot.
std::string hint_of(const Context& context, const RunOptions& given,
                    const std::vector<run::Input>& inputs, const run::Options& options) {
  const auto want = run::want(inputs, options);
  if (!want)
    return "";
  const bool has_world =
      (given.port.port.empty() && given.replay.empty()) || drives_virtual(context, given);
  return has_world || want->answers ? "hint: " + want->advice : "";
}

/// The numbers of `--input` plus another one.
std::string one_more(const run::Options& options) {
  return fmt::format("{}{}20", fmt::join(options.numbers, ","), options.numbers.empty() ? "" : ",");
}

tl::expected<void, Failure> run_files(Context& context, RunOptions given) {
  if (is_room(given))
    return run_together(context, given);
  auto options = read_options(context, given);
  if (!options)
    return tl::unexpected(options.error());
  const auto profile = take_profile(given);
  if (!profile)
    return tl::unexpected(profile.error());
  if (!given.port.port.empty() || !given.replay.empty())
    if (auto fits = check_for_robot(context, given, *options); !fits)
      return fits;
  const auto inputs = read_inputs(given.files, given.language, options->target);
  if (!inputs)
    return tl::unexpected(inputs.error());
  if (auto good = check_inputs(context, *inputs); !good)
    return good;
  const auto before = read_before(given);
  if (!before)
    return tl::unexpected(before.error());
  if (auto numbered = run::check_start_line(*inputs, options->line); !numbered)
    return tl::unexpected(numbered.error());
  std::optional<report::Course> course;
  if (auto done = take_course(context, given.course, course, *options); !done)
    return done;
  const auto want = hint_of(context, given, *inputs, *options);
  if (!want.empty())
    print_note(context, want);
  Console console(given, *inputs);
  std::optional<report::Journey> journey;
  if (!given.report.empty() || !given.svg.empty())
    journey.emplace();
  auto* const notes = journey ? &*journey : nullptr;
  std::optional<Failure> broken; // why a run on a robot could not continue
  std::optional<Slept> slept;
  std::optional<report::Journey> planned; // the simulated run, next to that of the robot
  const auto ending = [&]() -> tl::expected<run::Ending, Failure> {
    if (given.port.port.empty() && given.replay.empty())
      return run::run(*inputs, *options, console, notes);
    auto on_robot = given.replay.empty()
                        ? run_on_robot(context, given, *options, *inputs, console, notes)
                        : replay_drive(given, *options, *inputs, console, notes);
    if (!on_robot)
      return tl::unexpected(on_robot.error());
    slept = std::move(on_robot->slept);
    auto* driven = &on_robot->driven;
    broken = std::move(driven->failure);
    if (!given.svg.empty() && options->asks == run::Asks::No)
      plan(*inputs, *options, driven->robot, planned.emplace());
    if (!driven->left.empty())
      broken = Failure{ExitCode::BadInput, driven->left};
    return std::move(driven->ending);
  }();
  if (!ending)
    return tl::unexpected(ending.error());
  auto written = console.finish(*ending);
  for (const auto& fault : ending->faults)
    print_fault(context, fault);
  if (written && journey)
    written = write_pictures(given, *journey, planned ? &*planned : nullptr, *before);
  if (!written) // report the end of the run anyway
    print_error(context, written.error().message);
  tell_end(context, given, *ending, run::why(*inputs, *ending));
  if (want.empty() && ending->reason == run::Reason::Input && options->asks == run::Asks::No)
    print_note(context, fmt::format("hint: answer it with `--input {}`", one_more(*options)));
  if (*profile)
    hint_at_guesses(context, given, **profile, console);
  if (ending->robot_stopped)
    print_ended(context, *ending->robot_stopped ? ExitCode::Done : ExitCode::LinkLost,
                stop_note(*ending));
  if (slept)
    print_ended(context, slept->exit, slept->words);
  if (!ending->only_interpreted.empty() && context.verbosity > 0)
    print_note(context, fmt::format("only interpreted: {}", ending->only_interpreted));
  write_perf_map(context, ending->machine_code);
  if (given.open && !given.watch && written)
    show(context, given);
  if (console.lost() && InterruptGuard::asked() == 0)
    throw *console.lost(); // the robot has been stopped
  if (broken)
    return tl::unexpected(*std::move(broken));
  if (auto good = judge(given, *ending); !good)
    return good;
  if (!ending->aborted.empty())
    return refuse(ExitCode::BadInput, ending->aborted);
  if (!console.no_number().empty())
    return refuse(ExitCode::BadInput, console.no_number());
  if (!ending->faults.empty())
    context.exit = ExitCode::BadInput;
  else if (!written)
    context.exit = ExitCode::File;
  else if (!ending->robot_stopped.value_or(true))
    context.exit = ExitCode::LinkLost;
  else if (slept)
    context.exit = slept->exit;
  return {};
}

void run_and_report(Context& context, const RunOptions& options) {
  if (const auto done = run_files(context, options); !done)
    fail(context, done.error());
}

void run_and_watch(Context& context, const RunOptions& options,
                   const std::vector<std::string>& made_up) {
  const auto files = [&] {
    const auto opened = open_rooms(options.files); // a broken file is reported by the run
    auto all = files_of(opened ? *opened : options.files, options.language);
    std::copy_if(options.files.begin(), options.files.end(), std::back_inserter(all), is_room_file);
    for (const auto& stimulus : options.stimuli)
      if (!is_stimulus_line(stimulus))
        all.push_back(stimulus);
    if (!options.course.empty())
      all.push_back(options.course);
    return all;
  };
  const auto written = [&] {
    std::error_code absent;
    return std::filesystem::last_write_time(disk::as_path(options.report), absent);
  };
  const auto before = written();
  bool shown = !options.open;
  watch(
      context, files, [&] { run_and_report(context, options); },
      [&] {
        if (shown || written() == before)
          return; // the page reloads itself, or does not exist yet
        shown = true;
        show(context, options);
      },
      made_up);
}

/// Runs once or at every change, and writes the page that the options ask for.
void run_with_report(Context& context, RunOptions& options) {
  if (options.open && options.report == "-")
    return fail(context, {ExitCode::Usage, "`--open` needs a report in a file; omit `--report -`"});
  if (!options.record.empty() && options.port.port.empty())
    return fail(context,
                {ExitCode::Usage, "`--record` records a run on a robot; add `--port URL`"});
  if (!options.replay.empty() && !options.port.port.empty())
    return fail(context, {ExitCode::Usage, "`--replay` needs no robot; omit `--port`"});
  if (options.sleeps && options.port.port.empty())
    return fail(context, {ExitCode::Usage, "`--sleep` puts a robot to sleep; add `--port URL`"});
  if (options.watch && !options.port.port.empty())
    return fail(context,
                {ExitCode::Usage, "`--watch` would drive the robot on every change; do not "
                                  "use it with `--port`"});
  const bool temporary = options.open && options.report.empty();
  std::vector<std::string> made_up;
  if (temporary) {
    auto report = temporary_report(options.files.front());
    if (!report)
      return fail(context, report.error());
    options.report = *std::move(report);
    made_up = {"--report", options.report};
  }
  if (!options.compare.empty() && options.report.empty())
    return fail(context, {ExitCode::Usage,
                          "`--compare` shows a report; add `--report OUT.html` or `--open`"});
  if (options.watch)
    run_and_watch(context, options, made_up);
  else
    run_and_report(context, options);
  if (std::error_code not_empty; temporary)
    std::filesystem::remove(disk::as_path(options.report).parent_path(), not_empty);
}

void add_program_options(const Command& command, RunOptions& options) {
  command
      .add_option("FILE", options.files,
                  "programs and macros; the first one runs. Or a room: ROOM.toml")
      .required();
  add_language_option(command, options.language);
  command.add_option("--for", options.time, "robot time after which the run is stopped; 0: never")
      .show_default();
  command.add_option("--line", options.run.line, "the line to start at; by default the first")
      .check(whole_number(spec::value_of(spec::Limit::LeastLineNumber),
                          spec::value_of(spec::Limit::GreatestLineNumber)));
  command.add_option("--seed", options.run.seed, "the seed of all random choices")
      .check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      .show_default();
  command.add_option(
      "--input", options.input,
      "numbers for `input`, separated by commas; @stdin reads them as they are asked for");
  command.add_flag("--disconnected", options.disconnected, "run with no client connected");
  command.add_option(
      "--expect", options.run.expect,
      "text that must be printed; it ends the run with exit 0; exit 1 if it is never printed");
  command.add_option("--fail-text", options.run.fail_text,
                     "text that must not be printed; it ends the run with exit 1");
}

void add_ball_options(const Command& command, RunOptions& options) {
  add_target_options(command, options.target);
  command
      .add_option(
          "--firmware",
          [&options](const std::string& name) {
            options.firmware = name;
            options.firmware_given = true;
          },
          "the firmware to simulate")
      .show_default(options.firmware)
      .check(one_of(names_of(spec::firmwares)))
      .show_default();
  command.add_flag("--lenient", options.lenient,
                   "clamp colours and wrap negative headings, as some robots seem to do");
  add_stimulus_option(command, options.stimuli);
  add_course_option(command, options.course);
  command
      .add_option("--lines-per-second", options.run.lines_per_second,
                  "speed of the robot's interpreter in lines per second, 1 to 1000000000")
      .check(whole_number(1, 1'000'000'000))
      .show_default();
  command
      .add_option(
          "--native", options.native,
          "when programs become machine code: auto (once they have run for a while), on (at "
          "once) or off")
      .check(one_of({"auto", "on", "off"}))
      .show_default();
  command.add_flag("--realtime", options.realtime, "take as long as the robot would");
}

void add_tether_options(const Command& command, RunOptions& options) {
  options.port.port.clear();
  add_robot_roster_options(command, options.roster, "all");
  add_robot_options(command, options.port, options.robot);
  add_ball_option(command, options.ball,
                  "the virtual ball drives like the robot that `orb calibrate` measured");
  command.add_option("--record", options.record, "record all traffic with the robot in this file");
  command.add_option("--replay", options.replay,
                     "repeat the run from a file that --record wrote, without a robot");
  add_sleep_option(command, options.sleeps);
  command.add_flag("--no-aim", options.keep_aim,
                   "keeps the robot's heading and position; otherwise both start at 0");
}

void add_output_options(const Command& command, RunOptions& options) {
  command.add_option("--trace", options.trace, "one event per line, instead of the output")
      .check(one_of({"json", "csv"}));
  command.add_flag("--trace-lines", options.run.trace_lines, "also trace every executed line");
  command.add_option("--trace-out", options.trace_out, "the file for the trace");
  command.add_option("--report", options.report, "write a page that plays the run back");
  command.add_flag("--open", options.open,
                   "opens that page in a browser; without --report, a temporary one");
  command.add_option("--compare", options.compare,
                     "show the run from an earlier report page next to this one");
  command.add_option("--svg", options.svg, "draw the path");
  command.add_flag("--watch", options.watch, "run again whenever a file changes");
}

void add_room_options(const Command& command, RunOptions& options) {
  command.add_flag("--together", options.together, "each FILE drives its own ball, in one room");
}

} // namespace

void add_run(const Command& orb, Context& context) {
  const auto command = orb.add_command(
      "run", "run programs and macros on a virtual ball, in virtual time",
      "orb run square.bas\norb run square.bas --trace json | head\norb run guess.bas "
      "--input 50,25,37 --for 2min\norb run square.bas --open\norb run dice.bas "
      "--stimulus \"at 2s shake\"\norb run maze.bas --stimulus maze.stimulus --svg "
      "maze.svg\norb run parking.bas --course parking.svg --open\norb run dance.bas "
      "waltz.sphero --expect done\norb run red.orb blue.orb --together --open\norb "
      "run square.orb --port ble://SB-1A2B\norb run square.orb --ports class.toml\norb run "
      "square.orb "
      "--ball red");
  auto options = std::make_shared<RunOptions>();
  add_program_options(command, *options);
  add_ball_options(command, *options);
  add_tether_options(command, *options);
  add_output_options(command, *options);
  add_room_options(command, *options);
  command.callback([&context, options] {
    if (options->roster.ports.empty() && options->roster.file.empty())
      run_with_report(context, *options);
    else
      run_on_robots(context, *options, run_with_report);
  });
}

} // namespace orb::cli
