#include "run/run.h"

#include "compiler/check.h"
#include "compiler/load.h"
#include "run/want.h"
#include "uploader/upload.h"
#include "vm/ball_transport.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace orb::run {
namespace {

/// The programs and macros of all inputs, in their order.
struct Load {
  struct ProgramOf {
    const Input* input;
    const Program* program;
  };
  std::vector<ProgramOf> programs;
  std::vector<const Macro*> macros;
};

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

spec::Area other(spec::Area area) {
  return area == spec::Area::Ram ? spec::Area::Flash : spec::Area::Ram;
}

/// Finds a text in output that arrives in pieces.
class Search {
public:
  explicit Search(const std::string& text) : text_(text) {}

  bool seen() const { return seen_; }
  void take(std::string_view piece) {
    if (text_.empty() || seen_)
      return;
    window_ += piece;
    seen_ = window_.find(text_) != std::string::npos;
    if (window_.size() >= text_.size())
      window_.erase(0, window_.size() - text_.size() + 1);
  }

private:
  const std::string& text_;
  std::string window_;
  bool seen_ = false;
};

/// Sees everything that happens from the start of the program to its end, and hands it on.
class Watcher final : public vm::Observer, public vm::StepObserver {
public:
  Watcher(const Load& load, const Options& options, Listener& listener, report::Journey* journey)
      : load_(load), target_(options.target), until_(options.until), listener_(listener),
        journey_(journey), expected_(options.expect), forbidden_(options.fail_text) {}

  /// From when on the ball's events are those of the run.
  enum class From : std::uint8_t {
    Now,
    FirstCommand, ///< of a macro that plays while it arrives
  };
  void begin(vm::Ball& ball, From from) {
    ball_ = &ball;
    start_ = ball.now();
    from_ = from;
  }

  void on_event(Instant at, const vm::Event& event) override {
    if (ball_ == nullptr || enough_)
      return;
    if (over_)
      return roll_out(at, event);
    if (from_ == From::FirstCommand) {
      if (!std::holds_alternative<vm::event::Macro>(event))
        return;
      start_ = at;
      from_ = From::Now;
    }
    const bool was_idle = ball_->idle(); // of what goes on afterwards only how it ended counts
    if (!take(event) && was_idle) {
      over_ = at;
      roll_out(at, event);
      return;
    }
    if (std::holds_alternative<vm::event::End>(event) && was_idle)
      over_ = at;
    tell(at - start_, event);
  }

  void on_step(Instant at, const vm::Body& body) override {
    if (ball_ == nullptr || from_ == From::FirstCommand)
      return;
    listener_.on_step(at - start_, body);
    stop_if_enough();
  }

  bool is_enough() const { return enough_; }

  Instant start() const { return start_; }
  std::optional<Instant> over() const { return over_; } ///< since then nothing runs any more
  Sought seen() const {
    return forbidden_.seen()  ? Sought::Forbidden
           : expected_.seen() ? Sought::Expected
                              : Sought::Nothing;
  }
  const std::vector<ProgramError>& faults() const { return faults_; }
  std::optional<vm::event::End::Reason> end() const { return end_; }
  const std::optional<vm::event::MacroEnd>& macro_end() const { return macro_end_; }
  std::uint64_t lines() const { return lines_; }
  /// What there was to see, up to now.
  Sight sight() const {
    Sight seen = sight_;
    const auto& body = ball_->body();
    seen.pose = body.pose();
    seen.way_cm = body.rolled_cm();
    seen.motion = body.speed_setpoint() != 0 ? Sight::Motion::Driven
                  : body.stopped()           ? Sight::Motion::Still
                                             : Sight::Motion::Rolling;
    return seen;
  }

private:
  /// After the end of the program only what the ball's motion leads to counts.
  void roll_out(Instant at, const vm::Event& event) {
    if (until_ == Until::Rest && (std::holds_alternative<vm::event::Bump>(event) ||
                                  std::holds_alternative<vm::event::Position>(event)))
      tell(at - start_, event);
  }

  void stop_if_enough() {
    if (!listener_.enough())
      return;
    enough_ = true;
    ball_->interrupt();
  }

  void tell(Duration t, const vm::Event& event) {
    look(event);
    const auto* error = std::get_if<vm::event::Error>(&event);
    if (error == nullptr)
      listener_.on_event(t, event);
    else
      listener_.on_fault(t, add_fault(*error));
    stop_if_enough();
    if (journey_ == nullptr)
      return;
    journey_->add(t, event);
    if (error != nullptr)
      journey_->explain(faults_.back().cause.seen);
    journey_->sample(t, ball_->body());
  }

  /// Notes what the ending is made of; whether the event is part of it even after the program.
  bool take(const vm::Event& event) {
    if (const auto* print = std::get_if<vm::event::Print>(&event)) {
      expected_.take(print->text);
      forbidden_.take(print->text);
      if (seen() != Sought::Nothing)
        ball_->interrupt();
      return true;
    }
    if (std::holds_alternative<vm::event::Error>(event))
      return true;
    if (const auto* end = std::get_if<vm::event::End>(&event)) {
      end_ = end->reason;
      lines_ += end->lines;
      return true;
    }
    if (const auto* end = std::get_if<vm::event::MacroEnd>(&event))
      macro_end_ = *end;
    return false;
  }

  /// The error with what the source and the machine, which still stands there, say of it.
  const ProgramError& add_fault(const vm::event::Error& error) {
    const bool first = ball_->basic_area() == target_.area || load_.programs.size() < 2;
    return faults_.emplace_back(run::explain(*load_.programs[first ? 0 : 1].input, target_,
                                             error.line, error.code, &ball_->machine()));
  }

  void look(const vm::Event& event) {
    if (const auto* drive = std::get_if<vm::event::Drive>(&event))
      sight_.told_to_move |= drive->roll.speed != 0;
    else if (const auto* place = std::get_if<vm::event::Position>(&event))
      sight_.turned |= place->pose.heading_deg != 0;
    else if (const auto* led = std::get_if<vm::event::Led>(&event);
             led != nullptr && !ball_->blinks())
      sight_.color = led->color;
    else if (const auto* bump = std::get_if<vm::event::Bump>(&event)) {
      ++sight_.bumps;
      if (std::find(sight_.walls.begin(), sight_.walls.end(), bump->wall) == sight_.walls.end())
        sight_.walls.push_back(bump->wall);
    }
  }

  vm::Ball* ball_ = nullptr;
  From from_ = From::Now;
  Instant start_{};
  const Load& load_;
  const compiler::Target& target_;
  Until until_;
  bool enough_ = false;
  Listener& listener_;
  report::Journey* journey_;
  Search expected_;
  Search forbidden_;
  std::vector<ProgramError> faults_;
  std::optional<vm::event::End::Reason> end_;
  std::optional<vm::event::MacroEnd> macro_end_;
  std::uint64_t lines_ = 0;
  std::optional<Instant> over_;
  Sight sight_;
};

vm::BallOptions ball_options(const Options& options, Watcher& watcher,
                             const report::Journey* journey) {
  vm::BallOptions ball;
  ball.seed = options.seed;
  ball.lines_per_second = options.lines_per_second;
  ball.firmware = options.firmware;
  ball.ram_bytes = options.ram_bytes.value_or(spec::info(options.firmware).ram_bytes());
  ball.loader = compiler::load;
  ball.native = options.native;
  ball.native_programs = options.native_programs;
  ball.observer = &watcher;
  ball.steps = options.steps == Steps::Heard ? &watcher : nullptr;
  ball.trace_lines = options.trace_lines || journey != nullptr;
  return ball;
}

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

/// Brings everything into the ball the way any client would.
tl::expected<void, Failure> upload(const Load& load, spec::Area area, uploader::Session& session) {
  uploader::Delivery delivery;
  // The last temporary macro stays, and the first is the one to run.
  for (auto macro = load.macros.rbegin(); macro != load.macros.rend(); ++macro)
    if (auto job = job_of(**macro); job.kind != uploader::MacroKind::Stream) // see start()
      delivery.macros.push_back({(*macro)->name, std::move(job)});
  // Flash first: on its way there a program passes through RAM.
  for (const auto there : {spec::Area::Flash, spec::Area::Ram})
    for (std::size_t i = 0; i < load.programs.size(); ++i) {
      if ((i == 0 ? area : other(area)) != there)
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

/// What the ball answers to the command that starts the run.
class Answer {
public:
  void take(ByteView bytes) {
    if (code_)
      return;
    decoder_.feed(bytes);
    while (const auto item = decoder_.next())
      if (item->kind == protocol::Item::Kind::Response) {
        code_ = item->code;
        return;
      }
  }
  bool refused() const {
    return code_ && *code_ != static_cast<std::uint8_t>(spec::ResponseCode::Ok);
  }

private:
  protocol::Decoder decoder_{protocol::Direction::FromBall};
  std::optional<std::uint8_t> code_;
};

/// What a start without a client came to; with one, the answer tells.
enum class Started : std::uint8_t { Yes, Refused };

/// Sends one packet at this very instant.
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

/// Why the ball does not start what it was given.
Failure refusal(const Load& load, const Options& options) {
  if (!load.programs.empty())
    return {ExitCode::Refused, fmt::format("the ball does not run the program: its firmware {} "
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

/// Lets the ball live until the run is over or `limit` is reached.
void live(vm::Ball& ball, const Watcher& watcher, Listener& listener, Answer& answer, Instant limit,
          Duration slice) {
  while (ball.now() < limit) {
    ball.advance_until_quiet(std::min(limit, ball.now() + slice));
    answer.take(ball.take_output());
    if (watcher.seen() != Sought::Nothing || watcher.is_enough())
      return;
    if (ball.machine().waits_for_input() && !ball.input_queued()) {
      if (const auto value = listener.ask_number()) {
        ball.queue_input(*value);
        continue;
      }
    }
    if (ball.quiet())
      return;
    listener.on_time(ball.now() - watcher.start());
  }
}

/// Lets the ball roll until it rests, or something that it runs into starts a macro.
void roll_out(vm::Ball& ball, const Watcher& watcher, Listener& listener, Instant limit,
              Duration slice) {
  constexpr Duration glance = 100ms; // it is looked at that often
  while (ball.quiet() && ball.body().moving() && !watcher.is_enough() && ball.now() < limit) {
    ball.advance_to(std::min({limit, ball.now() + slice, ball.now() + glance}));
    listener.on_time(ball.now() - watcher.start());
  }
}

/// Why a macro aborted by itself; empty where it did not.
std::string_view why(const vm::event::MacroEnd& end) {
  switch (end.reason) {
  case vm::event::MacroEnd::Reason::Ended:
  case vm::event::MacroEnd::Reason::Aborted:
  case vm::event::MacroEnd::Reason::Slept: return {};
  case vm::event::MacroEnd::Reason::NoSuchMacro:
    return "it jumps to an id that no macro of the ball has; add that macro to the command line";
  case vm::event::MacroEnd::Reason::BadCommand:
    return "what follows is not a whole command; see `orb asm --listing`";
  case vm::event::MacroEnd::Reason::StreamEnd: return "`stream_end` ends only streams; write `end`";
  case vm::event::MacroEnd::Reason::Inhibited:
    return "it leads to a macro that `inh_if_conn` keeps from running while a client is connected";
  }
  return {};
}

std::string how_aborted(const std::optional<vm::event::MacroEnd>& end) {
  if (!end || why(*end).empty())
    return {};
  return fmt::format("macro {} aborted at its command {}: {}", end->macro, end->command, why(*end));
}

Reason reason_of(const vm::Ball& ball, const Watcher& watcher, Instant limit) {
  if (!watcher.faults().empty())
    return Reason::Error;
  if (watcher.seen() != Sought::Nothing || watcher.is_enough())
    return Reason::Abort;
  if (ball.basic_running() && ball.quiet())
    return Reason::Input;
  if (!ball.quiet() && ball.now() >= limit)
    return Reason::TimeLimit;
  if (!watcher.end() && watcher.macro_end()) {
    if (watcher.macro_end()->reason == vm::event::MacroEnd::Reason::Slept)
      return Reason::Sleep;
    return why(*watcher.macro_end()).empty() ? Reason::End : Reason::Abort;
  }
  switch (watcher.end().value_or(vm::event::End::Reason::End)) {
  case vm::event::End::Reason::End: return Reason::End;
  case vm::event::End::Reason::Error: return Reason::Error;
  case vm::event::End::Reason::Abort: return Reason::Abort;
  case vm::event::End::Reason::Sleep: return Reason::Sleep;
  }
  return Reason::End;
}

/// What a run that came to no end by itself waits for.
std::string waits_for(Reason reason, std::span<const Input> inputs, const Options& options,
                      const vm::Ball& ball) {
  if (reason == Reason::Input)
    return fmt::format("a number in {}", first_with_program(inputs)->program->where(
                                             static_cast<std::uint32_t>(ball.machine().line())));
  const auto found = reason == Reason::TimeLimit ? want(inputs, options) : std::nullopt;
  return found ? std::string(found->what) : std::string();
}

/// Tells the journey which files there are and where the robot's lines and commands stand in them.
void describe(std::span<const Input> inputs, const Options& options, report::Journey& journey) {
  bool first = true; // of two programs the lines of the second are told by their number alone
  for (const auto& input : inputs) {
    const auto& source = *input.source;
    const bool has_lines =
        std::any_of(input.macros.begin(), input.macros.end(),
                    [](const Macro& macro) { return !macro.command_lines.empty(); });
    if (!input.program && !has_lines)
      continue;
    const int file = journey.add_file(source.name(), std::string(source.text()));
    for (const auto& other : input.included)
      journey.add_file(other.source->name(), std::string(other.source->text()));
    if (input.program && std::exchange(first, false)) {
      journey.tell_places(input.program->compiled ? report::Told::Source : report::Told::RobotLine);
      for (const auto& [line, place] : input.program->lines.places)
        journey.map_line(static_cast<int>(line),
                         {file + static_cast<int>(place.file), static_cast<int>(place.line)});
    }
    for (const auto& macro : input.macros)
      for (std::size_t k = 0; k < macro.command_lines.size(); ++k)
        journey.map_command(macro.image.id, static_cast<int>(k) + 1,
                            {file, static_cast<int>(macro.command_lines[k])});
  }
  if (options.course != nullptr)
    journey.set_course(*options.course);
  for (const auto& event : options.stimuli)
    if (const auto* wall = std::get_if<vm::Wall>(&event.stimulus))
      journey.add_wall(*wall);
}

/// That the inputs cannot be run; nothing where they can.
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
                   fmt::format("macro `{}` holds no command, not even the final 00",
                               load.macros.front()->name)};
  for (const auto* macro : load.macros)
    if (const auto size = encode(macro->image).size();
        job_of(*macro).kind == uploader::MacroKind::User && size > spec::macro_max_packet)
      return Failure{ExitCode::BadInput,
                     fmt::format("macro `{}` has an id and {} bytes; a ball keeps at most {} under "
                                 "an id. Without `id=` it runs as a temporary or streamed macro",
                                 macro->name, size, spec::macro_max_packet)};
  return std::nullopt;
}

/// What the world does to the ball.
void schedule(const Options& options, vm::Ball& ball) {
  if (options.course != nullptr)
    ball.schedule(options.course->stimuli());
  ball.schedule(options.stimuli);
  for (const auto number : options.numbers)
    ball.queue_input(number);
}

Ending ending_of(std::span<const Input> inputs, const Options& options, const Watcher& watcher,
                 const vm::Ball& ball, Instant limit) {
  Ending ending;
  ending.reason = reason_of(ball, watcher, limit);
  ending.lines = watcher.lines() + (ball.basic_running() ? ball.machine().lines() : 0);
  ending.lasted = watcher.over().value_or(ball.idle_since().value_or(ball.now())) - watcher.start();
  ending.seen_to = options.until == Until::Rest
                       ? std::max(ending.lasted, ball.now() - watcher.start())
                       : ending.lasted;
  ending.seen = watcher.seen();
  ending.only_interpreted = ball.machine().only_interpreted();
  if (const auto* code = ball.machine().machine_code())
    ending.machine_code = code->pieces();
  ending.aborted = how_aborted(watcher.macro_end());
  ending.sight = watcher.sight();
  ending.waits_for = waits_for(ending.reason, inputs, options, ball);
  ending.faults = watcher.faults();
  return ending;
}

} // namespace

tl::expected<Ending, Failure> run(std::span<const Input> inputs, const Options& options,
                                  Listener& listener, report::Journey* journey) {
  const auto load = load_of(inputs);
  if (auto why = objection(load))
    return tl::unexpected(*std::move(why));
  Watcher watcher(load, options, listener, journey);
  vm::Ball ball(ball_options(options, watcher, journey));
  vm::BallTransport transport(ball);
  uploader::Session session(transport, {}, 0);
  if (auto done = upload(load, options.target.area, session); !done)
    return tl::unexpected(done.error());

  // A whole second, so that times in a trace do not depend on how long the upload took.
  ball.advance_to(ball.now() + 1s - ball.now().time_since_epoch() % 1s);
  ball.take_output();
  if (options.client == Client::Absent)
    ball.disconnect();
  const bool streams =
      load.programs.empty() && job_of(*load.macros.front()).kind == uploader::MacroKind::Stream;
  listener.on_start(ball);
  watcher.begin(ball, streams ? Watcher::From::FirstCommand : Watcher::From::Now);
  if (journey != nullptr)
    describe(inputs, options, *journey);
  schedule(options, ball);
  const auto started = load.programs.empty()
                           ? start_macro(*load.macros.front(), options, ball, session)
                           : start_program(*load.programs.front().program, options, ball);
  const Instant limit = options.bound == Duration{} ? never - 1h : watcher.start() + options.bound;
  Answer answer;
  if (started == Started::Yes) {
    live(ball, watcher, listener, answer, limit, options.slice);
    while (options.until == Until::Rest && ball.quiet() && ball.body().moving() &&
           !watcher.is_enough() && ball.now() < limit) {
      roll_out(ball, watcher, listener, limit, options.slice);
      live(ball, watcher, listener, answer, limit, options.slice);
    }
  }
  if (started == Started::Refused || answer.refused())
    return tl::unexpected(refusal(load, options));

  const auto ending = ending_of(inputs, options, watcher, ball, limit);
  listener.on_end(ending);
  if (journey != nullptr)
    journey->finish(ending.seen_to, std::string(to_string(ending.reason)), to_string(ending));
  return ending;
}

} // namespace orb::run
