#include "cli/commands.h"
#include "cli/options.h"
#include "cli/run_hints.h"
#include "cli/run_inputs.h"
#include "cli/target.h"
#include "cli/watch.h"
#include "compiler/check.h"
#include "compiler/load.h"
#include "disk/disk.h"
#include "report/journey.h"
#include "report/page.h"
#include "report/svg.h"
#include "report/trace.h"
#include "spec/firmware.h"
#include "uploader/upload.h"
#include "vm/ball_transport.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <thread>

namespace orb::cli {

namespace {

struct RunOptions {
  std::vector<std::string> files;
  std::string language;
  std::string time = "60s";
  std::optional<std::uint16_t> line;
  std::uint64_t seed = 1;
  std::string input;
  bool disconnected = false;
  TargetOptions target;
  std::string firmware = std::string(spec::info(spec::default_firmware).name);
  std::string stimulus;
  std::uint32_t lines_per_second =
      static_cast<std::uint32_t>(spec::value_of(spec::Limit::LinesPerSecond));
  std::string trace;
  bool trace_lines = false;
  std::string trace_out;
  std::string report;
  std::string svg;
  std::string expect;
  std::string fail_text;
  bool realtime = false;
  bool watch = false;
};

// --- watching -----------------------------------------------------------------------------------

/// Where the trace goes: stdout as it happens, or a file that appears whole at the end.
class TraceSink {
public:
  explicit TraceSink(const RunOptions& options)
      : path_(options.trace_out), lines_(options.trace_lines) {
    if (!options.trace.empty() || !path_.empty())
      format_ = options.trace == "csv" ? report::TraceFormat::Csv : report::TraceFormat::Json;
    if (options.trace.empty() && path_.ends_with(".csv"))
      format_ = report::TraceFormat::Csv;
    if (format_)
      put(report::trace_head(*format_));
  }

  bool replaces_output() const { return format_ && path_.empty(); }
  void add(Duration t, const vm::Event& event) {
    if (format_ && (lines_ || !std::holds_alternative<vm::event::Line>(event)))
      put(report::trace_line(*format_, t, event));
  }
  void finish(Duration t, std::string_view reason, std::uint64_t lines) {
    if (format_)
      put(report::trace_line(
          *format_, t, "end",
          {{"reason", std::string(reason)}, {"lines", static_cast<std::int64_t>(lines)}}));
  }
  tl::expected<void, IoError> close() {
    if (!format_ || path_.empty())
      return {};
    return disk::write(path_, as_bytes(text_));
  }

private:
  void put(std::string_view text) {
    if (path_.empty())
      print_out(text);
    else
      text_ += text;
  }

  std::optional<report::TraceFormat> format_;
  std::string path_;
  bool lines_; ///< a report sees every line even where the trace does not ask for them
  std::string text_;
};

/// Finds a text in output that arrives in pieces.
class Sought {
public:
  explicit Sought(std::string text) : text_(std::move(text)) {}

  bool wanted() const { return !text_.empty(); }
  bool seen() const { return seen_; }
  void take(std::string_view piece) {
    if (!wanted() || seen_)
      return;
    window_ += piece;
    seen_ = window_.find(text_) != std::string::npos;
    if (window_.size() >= text_.size())
      window_.erase(0, window_.size() - text_.size() + 1);
  }

private:
  std::string text_;
  std::string window_;
  bool seen_ = false;
};

struct Fault {
  int line = 0;
  spec::BasicError code{};
  vm::Area area = vm::Area::Ram;
};

/// Sees everything that happens from the start of the program to its end.
class Watcher final : public vm::Observer {
public:
  explicit Watcher(const RunOptions& options)
      : trace(options), expected(options.expect), forbidden(options.fail_text) {
    if (!options.report.empty() || !options.svg.empty())
      journey = std::make_unique<report::Journey>();
  }

  void on_event(Instant at, const vm::Event& event) override {
    if (!ball || over)
      return;
    bool told = !ball->idle(); // of what goes on afterwards only how it ended counts
    if (const auto* print = std::get_if<vm::event::Print>(&event)) {
      if (!trace.replaces_output())
        print_out(print->text);
      expected.take(print->text);
      forbidden.take(print->text);
      if (expected.seen() || forbidden.seen())
        ball->interrupt();
      told = true;
    } else if (const auto* error = std::get_if<vm::event::Error>(&event)) {
      faults.push_back({error->line, error->code, ball->basic_area()});
      told = true;
    } else if (const auto* end = std::get_if<vm::event::End>(&event)) {
      reason = end->reason;
      lines += end->lines;
      if (ball->idle())
        over = at;
      told = true;
    } else if (ball->idle()) {
      over = at;
    }
    if (!told)
      return;
    const Duration t = at - start;
    trace.add(t, event);
    if (journey) {
      journey->add(t, event);
      journey->sample(t, ball->body());
    }
  }

  vm::Ball* ball = nullptr; ///< set when the program starts
  Instant start{};
  std::optional<Instant> over; ///< since then nothing runs any more
  TraceSink trace;
  Sought expected;
  Sought forbidden;
  std::vector<Fault> faults;
  std::optional<vm::event::End::Reason> reason;
  std::uint64_t lines = 0;
  std::unique_ptr<report::Journey> journey;
};

// --- running ------------------------------------------------------------------------------------

ExitCode exit_code(uploader::Report::Kind kind) {
  using Kind = uploader::Report::Kind;
  switch (kind) {
  case Kind::Done: return ExitCode::Done;
  case Kind::Impossible: return ExitCode::BadInput;
  case Kind::Refused: return ExitCode::Refused;
  case Kind::NoBall: return ExitCode::NoBall;
  case Kind::LinkLost: return ExitCode::LinkLost;
  case Kind::Unknown: return ExitCode::Unknown;
  case Kind::Interrupted: return ExitCode::Interrupted;
  }
  return ExitCode::Bug;
}

RunResult<void> check(const uploader::Report& report) {
  if (report.kind == uploader::Report::Kind::Done)
    return {};
  return refuse(exit_code(report.kind), report.message);
}

/// Brings everything into the ball the way any client would.
RunResult<void> upload_all(const RunInputs& inputs, vm::Area area, uploader::Session& session) {
  const auto greeting = uploader::greet(session);
  if (!greeting)
    return refuse(exit_code(greeting.error().kind), greeting.error().message);
  uploader::NullProgress progress;
  // The last temporary macro stays, and the first is the one to run.
  for (auto macro = inputs.macros.rbegin(); macro != inputs.macros.rend(); ++macro) {
    uploader::MacroJob job{macro->image, uploader::natural_kind(macro->image), false, false};
    if (job.kind == uploader::MacroKind::Stream)
      continue; // plays while it arrives: see start()
    if (auto done = check(uploader::upload(session, job, progress)); !done)
      return done;
  }
  // Flash first: on its way there a program passes through RAM.
  for (const bool to_flash : {true, false})
    for (std::size_t i = 0; i < inputs.programs.size(); ++i) {
      if (((area == vm::Area::Flash) == (i == 0)) != to_flash)
        continue;
      uploader::ProgramJob job{inputs.programs[i]->image,
                               to_flash ? uploader::Area::Flash : uploader::Area::Ram,
                               std::nullopt};
      if (auto done = check(
              uploader::upload(session, job, *greeting, uploader::BatteryPolicy::Refuse, progress));
          !done)
        return done;
    }
  return {};
}

/// Sends one packet at this very instant.
void send_now(vm::Ball& ball, spec::ApiCommand command, Bytes data) {
  ball.receive(protocol::encode(protocol::make_command(command, std::move(data))));
}

/// Starts the program, or the first macro, at the ball's present instant.
RunResult<void> start(const RunInputs& inputs, const RunOptions& options, vm::Area area,
                      vm::Ball& ball, uploader::Session& session) {
  if (options.disconnected)
    ball.disconnect();
  if (inputs.programs.empty()) {
    const auto& image = inputs.macros.front().image;
    if (image.id == spec::macro_id_stream) {
      uploader::NullProgress progress;
      uploader::MacroJob job{image, uploader::MacroKind::Stream, false, false};
      return check(uploader::upload(session, job, progress));
    }
    if (options.disconnected) {
      ball.macros().start(image.id, ball.now());
      ball.macros_changed();
    } else {
      send_now(ball, spec::ApiCommand::RunMacro, {image.id});
    }
    return {};
  }
  const auto line =
      static_cast<std::uint16_t>(options.line.value_or(inputs.programs.front()->first_line));
  if (options.disconnected) {
    ball.execute_basic(area, line);
    return {};
  }
  Bytes data{static_cast<std::uint8_t>(area)};
  append_u16(data, line);
  send_now(ball, spec::ApiCommand::ExecuteOrbbasicProgram, std::move(data));
  return {};
}

/// `1,2,-3`; nothing where that is no list of 32-bit numbers.
std::optional<std::vector<std::int32_t>> read_numbers(std::string_view text) {
  std::vector<std::int32_t> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    std::int32_t value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{})
      return std::nullopt;
    numbers.push_back(value);
    if (next == end)
      return numbers;
    if (*next != ',')
      return std::nullopt;
    at = next + 1;
  }
}

/// The next number of standard input; nothing when there is none.
std::optional<std::int32_t> read_number() {
  std::int32_t value = 0;
  if (std::cin >> value)
    return value;
  return std::nullopt;
}

/// Lets the ball live until the run is over or `limit` is reached.
void live(vm::Ball& ball, const RunOptions& options, const Watcher& watcher, Instant limit) {
  constexpr Duration slice = 1s;
  constexpr Duration frame = 20ms; // of --realtime
  const auto clock_start = std::chrono::steady_clock::now();
  while (ball.now() < limit) {
    ball.advance_until_quiet(std::min(limit, ball.now() + (options.realtime ? frame : slice)));
    ball.take_output();
    if (watcher.expected.seen() || watcher.forbidden.seen())
      return;
    if (options.input == "@stdin" && ball.machine().waits_for_input() && !ball.input_queued()) {
      if (const auto value = read_number()) {
        ball.queue_input(*value);
        continue;
      }
    }
    if (ball.quiet())
      return;
    if (options.realtime) {
      std::fflush(stdout);
      std::this_thread::sleep_until(clock_start + (ball.now() - watcher.start));
    }
  }
}

std::string_view reason_of(const vm::Ball& ball, const Watcher& watcher, Instant limit) {
  if (!watcher.faults.empty())
    return "error";
  if (watcher.expected.seen() || watcher.forbidden.seen())
    return "abort";
  if (ball.basic_running() && ball.quiet())
    return "input";
  if (!ball.quiet() && ball.now() >= limit)
    return "time-limit";
  if (!watcher.reason)
    return "end";
  switch (*watcher.reason) {
  case vm::event::End::Reason::End: return "end";
  case vm::event::End::Reason::Error: return "error";
  case vm::event::End::Reason::Abort: return "abort";
  case vm::event::End::Reason::Sleep: return "sleep";
  }
  return "end";
}

std::string ending_words(std::string_view reason, Duration time, std::uint64_t lines) {
  const auto ms = time / std::chrono::milliseconds{1};
  const auto how = reason == "time-limit" ? "stopped by the time limit"
                   : reason == "input"    ? "still waiting for input, ended"
                   : reason == "abort"    ? "stopped"
                   : reason == "sleep"    ? "fell asleep, ended"
                                          : "ended";
  return fmt::format("{} after {}.{:03} s of robot time, {} lines", how, ms / 1000, ms % 1000,
                     lines);
}

/// Where a fault is in the user's file, and what the linter knows about that line.
void print_fault(const Fault& fault, const ProgramFile& file, const compiler::Target& target) {
  const auto& lines = file.program.lines;
  const auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& candidate) {
    return candidate.number == static_cast<std::uint32_t>(fault.line) && candidate.has_statement();
  });
  const auto message = fmt::format("error: line {}: {}", fault.line, spec::info(fault.code).text);
  if (line == lines.end()) {
    print_err(fmt::format("{}: {}\n", file.source.name(), message));
    return;
  }
  const auto span = file.program.statements[line->statement].span;
  const auto place = file.source.position(span.begin);
  print_err(fmt::format("{}:{}:{}: {}\n", file.source.name(), place.line, place.column, message));
  const auto checked = compiler::check(file.source.text(), target);
  for (const auto& diagnostic : checked.diagnostics)
    if (diagnostic.rule->robot_error == spec::code(fault.code) &&
        file.source.position(diagnostic.span.begin).line == place.line) {
      print_err(fmt::format("  {}\n", diagnostic.message));
      if (!diagnostic.help.empty())
        print_err(fmt::format("  help: {}\n", diagnostic.help));
      return;
    }
}

void describe(const RunInputs& inputs, vm::Area area, report::Journey& journey) {
  for (std::size_t i = 0; i < inputs.programs.size(); ++i) {
    const auto& file = *inputs.programs[i];
    const int number = journey.add_file(file.source.name(), std::string(file.source.text()));
    if (i > 0)
      continue; // lines are told by their number alone
    for (auto line = file.program.lines.rbegin(); line != file.program.lines.rend(); ++line)
      if (line->has_number())
        journey.map_line(static_cast<int>(line->number),
                         {number, static_cast<int>(file.source.position(line->span.begin).line)});
  }
  std::map<std::string, int> macro_files;
  for (const auto& macro : inputs.macros) {
    if (macro.text.empty())
      continue;
    const auto [file, fresh] = macro_files.try_emplace(macro.name, 0);
    if (fresh)
      file->second = journey.add_file(macro.name, macro.text);
    for (std::size_t k = 0; k < macro.command_lines.size(); ++k)
      journey.map_command(macro.image.id, static_cast<int>(k) + 1,
                          {file->second, macro.command_lines[k]});
  }
  for (const auto& event : inputs.stimuli)
    if (const auto* wall = std::get_if<vm::Wall>(&event.stimulus))
      journey.add_wall(*wall);
  static_cast<void>(area);
}

RunResult<void> write_pictures(const RunOptions& options, const report::Journey& journey) {
  const auto write = [](const std::string& path, const std::string& text) -> RunResult<void> {
    if (path.empty())
      return {};
    if (const auto done = disk::write(path, as_bytes(text)); !done)
      return refuse(ExitCode::File, done.error().message);
    return {};
  };
  if (auto done =
          write(options.report,
                options.report.empty()
                    ? std::string()
                    : report::report_page(journey, disk::display_name(options.files.front())));
      !done)
    return done;
  return write(options.svg, options.svg.empty() ? std::string() : report::path_svg(journey));
}

RunResult<void> run(Context& context, const RunOptions& options) {
  const auto time = read_duration(options.time);
  if (!time)
    return refuse(
        ExitCode::Usage,
        fmt::format("`--for {}` is no time; write it like 90s, 500ms or 2min", options.time));
  std::vector<std::int32_t> numbers;
  if (!options.input.empty() && options.input != "@stdin") {
    auto parsed = read_numbers(options.input);
    if (!parsed)
      return refuse(ExitCode::Usage,
                    fmt::format("`--input {}` is no list of numbers such as 1,2,3", options.input));
    numbers = std::move(*parsed);
  }
  const auto firmware = spec::find_firmware(options.firmware);
  if (!firmware)
    return refuse(ExitCode::Usage, fmt::format("no firmware is called `{}`", options.firmware));
  auto inputs = read_run_inputs(options.files, options.language, options.stimulus, context);
  if (!inputs)
    return tl::unexpected(inputs.error());

  Watcher watcher(options);
  vm::BallOptions ball_options;
  ball_options.seed = options.seed;
  ball_options.lines_per_second = options.lines_per_second;
  ball_options.firmware = firmware->firmware;
  ball_options.ram_bytes = options.target.ram != 0 ? static_cast<std::size_t>(options.target.ram)
                                                   : firmware->ram_bytes();
  ball_options.loader = compiler::load;
  ball_options.observer = &watcher;
  ball_options.trace_lines = options.trace_lines || watcher.journey;
  vm::Ball ball(ball_options);
  vm::BallTransport transport(ball);
  uploader::Session session(transport, {}, 0);
  const auto area = options.target.area == "flash" ? vm::Area::Flash : vm::Area::Ram;
  if (auto done = upload_all(*inputs, area, session); !done)
    return done;

  // A whole second, so that times in a trace do not depend on how long the upload took.
  ball.advance_to(ball.now() + 1s - ball.now().time_since_epoch() % 1s);
  ball.take_output();
  watcher.ball = &ball;
  watcher.start = ball.now();
  if (watcher.journey)
    describe(*inputs, area, *watcher.journey);
  ball.schedule(inputs->stimuli);
  for (const auto number : numbers)
    ball.queue_input(number);
  const Instant limit = *time == Duration{} ? never - 1h : watcher.start + *time;
  if (auto done = start(*inputs, options, area, ball, session); !done)
    return done;
  live(ball, options, watcher, limit);

  const auto reason = reason_of(ball, watcher, limit);
  const auto lines = watcher.lines + (ball.basic_running() ? ball.machine().lines() : 0);
  const Instant over = watcher.over.value_or(ball.idle_since().value_or(ball.now()));
  const Duration lasted = over - watcher.start;
  watcher.trace.finish(lasted, reason, lines);
  for (const auto& fault : watcher.faults) {
    const bool first = fault.area == area || inputs->programs.size() < 2;
    print_fault(fault, *inputs->programs[first ? 0 : 1], options.target.target());
  }
  watcher.ball = nullptr;
  const auto words = ending_words(reason, lasted, lines);
  if (const auto done = watcher.trace.close(); !done)
    return refuse(ExitCode::File, done.error().message);
  if (watcher.journey) {
    watcher.journey->finish(lasted, std::string(reason), words);
    if (auto done = write_pictures(options, *watcher.journey); !done)
      return done;
  }
  if (options.stimulus.empty() && !inputs->programs.empty())
    if (const auto hint = run_hint(reason, inputs->programs.front()->program); !hint.empty())
      print_note(context, "hint: " + hint);
  print_note(context, words);
  if (watcher.forbidden.seen())
    return refuse(ExitCode::BadInput, fmt::format("the program printed `{}`", options.fail_text));
  if (watcher.expected.wanted() && !watcher.expected.seen())
    return refuse(ExitCode::BadInput,
                  fmt::format("the program never printed `{}`", options.expect));
  if (!watcher.faults.empty())
    context.exit = ExitCode::BadInput;
  return {};
}

void run_and_report(Context& context, const RunOptions& options) {
  if (const auto done = run(context, options); !done) {
    print_error(context, done.error().message);
    context.exit = done.error().code;
  }
}

} // namespace

void add_run(CLI::App& app, Context& context) {
  auto* command =
      add_command(app, "run", "run programs and macros on a virtual ball, in virtual time",
                  "orb run square.bas\norb run square.bas --trace json | head\norb run guess.bas "
                  "--input 50,25,37 --for 2min\norb run maze.bas --stimulus maze.stimulus --svg "
                  "maze.svg\norb run dance.bas waltz.sphero --expect done");
  auto options = std::make_shared<RunOptions>();
  command->add_option("FILE", options->files, "orbBasic programs and macros; the first one runs")
      ->required();
  command->add_option("--lang", options->language, "what the files are, whatever their ending")
      ->check(one_of({"basic", "macro"}));
  command->add_option("--for", options->time, "robot time after which the run is stopped; 0: never")
      ->capture_default_str();
  command->add_option("--line", options->line, "the line to start at; else the first of the file");
  command->add_option("--seed", options->seed, "seeds all that is random")->capture_default_str();
  command->add_option("--input", options->input,
                      "numbers for `input`, parted by commas; @stdin reads them as they are asked");
  command->add_flag("--disconnected", options->disconnected, "no client is connected");
  add_target_options(*command, options->target);
  std::vector<std::string> names;
  for (const auto& row : spec::firmwares)
    names.emplace_back(row.name);
  command->add_option("--firmware", options->firmware, "the firmware that is simulated")
      ->check(one_of(std::move(names)))
      ->capture_default_str();
  command->add_option("--stimulus", options->stimulus, "a script of what happens to the ball");
  command
      ->add_option("--lines-per-second", options->lines_per_second,
                   "how fast the robot's interpreter is, 1 to 1000000000")
      ->check(CLI::Range(1u, 1'000'000'000u))
      ->capture_default_str();
  command->add_option("--trace", options->trace, "every event as a line, in place of the output")
      ->check(one_of({"json", "csv"}));
  command->add_flag("--trace-lines", options->trace_lines,
                    "the trace has every executed line, too");
  command->add_option("--trace-out", options->trace_out, "the file for the trace");
  command->add_option("--report", options->report, "writes a page that plays the run back");
  command->add_option("--svg", options->svg, "draws the path");
  command->add_option("--expect", options->expect, "stops well when this is printed, ill if never");
  command->add_option("--fail-text", options->fail_text, "stops ill when this is printed");
  command->add_flag("--realtime", options->realtime, "takes as long as the robot would");
  command->add_flag("--watch", options->watch, "runs again whenever a file changes");
  command->callback([&context, options] {
    if (!options->watch) {
      run_and_report(context, *options);
      return;
    }
    auto files = options->files;
    if (!options->stimulus.empty())
      files.push_back(options->stimulus);
    watch(context, files, [&] { run_and_report(context, *options); });
  });
}

} // namespace orb::cli
