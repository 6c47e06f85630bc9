#include "run/start.h"

#include "compiler/load.h"
#include "run/calibrate/profile.h"
#include "uploader/upload.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::run {

void Options::drive_like(const Profile& profile) {
  model = profile.robot;
  driving = profile.driving;
}

namespace {

tl::expected<void, Failure> deliver(uploader::Session& session,
                                    const uploader::Delivery& delivery) {
  uploader::NullProgress progress;
  const auto report =
      uploader::deliver(session, delivery, uploader::BatteryPolicy::Refuse, progress);
  if (report.kind == uploader::Report::Kind::Done)
    return {};
  return tl::unexpected(Failure{exit_code(report.kind), report.message});
}

uploader::MacroJob job_of(const Macro& macro) {
  return {macro.image, uploader::natural_kind(macro.image), false, false};
}

tl::expected<void, Failure> deliver(const Load& load, const Options& options,
                                    uploader::Session& session) {
  uploader::Delivery delivery;
  // Reverse order: the last temporary macro remains, and the first is the one to run.
  for (auto macro = load.macros.rbegin(); macro != load.macros.rend(); ++macro)
    if (auto job = job_of(**macro); job.kind != uploader::MacroKind::Stream) // see start_macro()
      delivery.macros.push_back({(*macro)->name, std::move(job)});
  // Flash first: a program reaches it through RAM.
  for (const auto there : {spec::Area::Flash, spec::Area::Ram})
    for (std::size_t i = 0; i < load.programs.size(); ++i) {
      if (area_of(i, options) != there)
        continue;
      const auto& [input, program] = load.programs[i];
      const auto bytes = as_bytes(program->image.bytes);
      delivery.program_name = input->source->name();
      delivery.program = uploader::ProgramJob{{bytes.begin(), bytes.end()}, there, std::nullopt};
      if (auto done = deliver(session, delivery); !done)
        return done;
      delivery = {};
    }
  return delivery.macros.empty() ? tl::expected<void, Failure>() : deliver(session, delivery);
}

/// Sends one packet at the present instant.
void send_now(vm::Ball& ball, spec::ApiCommand command, Bytes data) {
  ball.receive(protocol::encode(protocol::make_command(command, std::move(data))));
}

Started start_macro(const Macro& macro, const Options& options, vm::Ball& ball,
                    uploader::Session& session) {
  if (job_of(macro).kind == uploader::MacroKind::Stream) {
    uploader::NullProgress progress; // plays while it arrives
    const auto report = uploader::upload(session, job_of(macro), progress);
    return report.kind == uploader::Report::Kind::Done ? Started::Yes : Started::Refused;
  }
  if (options.client == Client::Absent)
    return ball.run_macro(macro.image.id) == vm::MacroOutcome::Done ? Started::Yes
                                                                    : Started::Refused;
  send_now(ball, spec::ApiCommand::RunMacro, {macro.image.id});
  return Started::Yes;
}

Started start_program(const Program& program, const Options& options, vm::Ball& ball) {
  const auto line = options.line.value_or(program.first_line().value_or(0));
  if (options.client == Client::Absent)
    return ball.execute_basic(options.target.area, line) == vm::Outcome::Done ? Started::Yes
                                                                              : Started::Refused;
  Bytes data{static_cast<std::uint8_t>(options.target.area)};
  append_u16(data, line);
  send_now(ball, spec::ApiCommand::ExecuteOrbbasicProgram, std::move(data));
  return Started::Yes;
}

/// Schedules the effects of the world on the ball.
void schedule(const Options& options, vm::Ball& ball) {
  if (options.course != nullptr)
    ball.schedule(options.course->stimuli());
  ball.schedule(options.stimuli);
  for (const auto number : options.numbers)
    ball.queue_input(number);
}

} // namespace

Load load_of(std::span<const Input> inputs) {
  Load load;
  for (const auto& input : inputs) {
    if (input.program)
      load.programs.push_back({&input, &*input.program});
    for (const auto& macro : input.macros)
      load.macros.push_back(&macro);
  }
  return load;
}

spec::Area area_of(std::size_t program, const Options& options) {
  const auto other = options.target.area == spec::Area::Ram ? spec::Area::Flash : spec::Area::Ram;
  return program == 0 ? options.target.area : other;
}

std::optional<Failure> objection(const Load& load) {
  if (load.programs.size() > 2)
    return Failure{ExitCode::Usage, "a ball holds two programs: one in RAM, one in flash"};
  for (const auto& [input, program] : load.programs)
    if (!program->first_line())
      return Failure{ExitCode::BadInput,
                     fmt::format("{} holds no program: no line begins with a line number and a "
                                 "statement",
                                 input->source->name())};
  if (load.programs.empty() && load.macros.empty())
    return Failure{ExitCode::BadInput, "there is no macro to run"};
  if (load.programs.empty() && load.macros.front()->image.body.empty())
    return Failure{ExitCode::BadInput,
                   fmt::format("macro `{}` has no commands, not even the final 00",
                               load.macros.front()->name)};
  for (const auto* macro : load.macros)
    if (const auto size = encode(macro->image).size();
        job_of(*macro).kind == uploader::MacroKind::User && size > spec::macro_max_packet)
      return Failure{
          ExitCode::BadInput,
          fmt::format("macro `{}` has an id and is {} bytes long; a ball stores at most "
                      "{} under an id; without `id=` it runs as a temporary or streamed macro",
                      macro->name, size, spec::macro_max_packet)};
  return std::nullopt;
}

vm::BallOptions ball_options(const Options& options) {
  vm::BallOptions ball;
  ball.seed = options.seed;
  ball.start = options.start;
  ball.lines_per_second = options.lines_per_second;
  ball.firmware = options.firmware;
  ball.robot = options.model;
  ball.driving = options.driving.value_or(spec::driving(options.model));
  ball.ram_bytes = options.ram_bytes.value_or(spec::info(options.firmware).ram_bytes());
  ball.ranges = options.ranges;
  ball.loader = compiler::load;
  ball.native = options.native;
  ball.native_programs = options.native_programs;
  return ball;
}

bool streams(const Load& load) {
  return load.programs.empty() && job_of(*load.macros.front()).kind == uploader::MacroKind::Stream;
}

tl::expected<void, Failure> upload(const Load& load, const Options& options, vm::Ball& ball,
                                   uploader::Session& session) {
  if (auto done = deliver(load, options, session); !done)
    return done;
  ball.advance_to(ball.now() + 1s - ball.now().time_since_epoch() % 1s);
  ball.take_output();
  if (options.client == Client::Absent)
    ball.disconnect();
  return {};
}

Started start(const Load& load, const Options& options, vm::Ball& ball,
              uploader::Session& session) {
  schedule(options, ball);
  return load.programs.empty() ? start_macro(*load.macros.front(), options, ball, session)
                               : start_program(*load.programs.front().program, options, ball);
}

Failure refusal(const Load& load, const Options& options) {
  if (!load.programs.empty())
    return {ExitCode::Refused, fmt::format("the ball cannot run the program: its firmware {} "
                                           "has no orbBasic; choose another with `--firmware`",
                                           spec::info(options.firmware).name)};
  const auto& macro = *load.macros.front();
  if (options.client == Client::Connected &&
      (macro.image.flags & static_cast<std::uint8_t>(spec::MacroFlag::InhIfConn)) != 0)
    return {ExitCode::Refused,
            fmt::format("the ball does not run macro `{}` while a client is connected: its flag "
                        "`inh_if_conn` forbids it; run it with `--disconnected`",
                        macro.name)};
  return {ExitCode::Refused, fmt::format("the ball does not run macro `{}`", macro.name)};
}

void describe(std::span<const Input> inputs, const Options& options, report::Journey& journey) {
  journey.set_robot(options.model);
  // Programs before the macros they may bring with them: a page opens on the first file.
  std::vector<const Input*> ordered;
  for (const auto& input : inputs)
    ordered.push_back(&input);
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const Input* one) { return one->program.has_value(); });
  bool first = true; // only the first of two programs is mapped to its source
  for (const auto* one : ordered) {
    const auto& input = *one;
    const auto& source = *input.source;
    const bool has_lines =
        std::any_of(input.macros.begin(), input.macros.end(),
                    [](const Macro& macro) { return !macro.command_lines.empty(); });
    if (!input.program && !has_lines)
      continue;
    const int file = journey.add_file(source.name(), std::string(source.text()));
    for (const auto& other : input.included)
      journey.add_file(other->name(), std::string(other->text()));
    if (input.program && std::exchange(first, false)) {
      journey.set_error_place(input.program->compiled ? report::ErrorPlace::Source
                                                      : report::ErrorPlace::RobotLine);
      for (const auto& [line, place] : input.program->lines.places)
        journey.map_line(static_cast<int>(line),
                         {file + static_cast<int>(place.file), static_cast<int>(place.line)});
    }
    for (const auto& macro : input.macros)
      for (std::size_t k = 0; k < macro.command_lines.size(); ++k)
        if (macro.command_lines[k] != 0)
          journey.map_command(macro.image.id, static_cast<int>(k) + 1,
                              {file, static_cast<int>(macro.command_lines[k])});
  }
  if (options.course != nullptr)
    journey.set_course(*options.course);
  for (const auto& event : options.stimuli)
    if (const auto* wall = std::get_if<vm::Wall>(&event.stimulus))
      journey.add_wall(*wall);
}

} // namespace orb::run
