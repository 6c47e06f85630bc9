#include "debug/debugger.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::debug {
namespace {

std::string fault_text(const run::ProgramError& fault) {
  std::string text(spec::info(fault.code).text);
  if (!fault.cause.seen.empty())
    text += fmt::format(": {}", fault.cause.seen);
  if (!fault.cause.variables.empty())
    text += fmt::format("; {}", fault.cause.variables);
  return text;
}

} // namespace

Debugger::Debugger(std::span<const run::Input> inputs, const run::Options& options,
                   Console& console)
    : inputs_(inputs), options_(options), console_(console), sources_(inputs, options) {}

Debugger::~Debugger() = default;

tl::expected<std::unique_ptr<Debugger>, Failure> Debugger::start(std::span<const run::Input> inputs,
                                                                 const run::Options& options,
                                                                 Console& console,
                                                                 run::HeldRobot* robot) {
  std::unique_ptr<Debugger> debugger(new Debugger(inputs, options, console));
  auto timeline = Timeline::start(inputs, debugger->options_, *debugger, robot);
  if (!timeline)
    return tl::unexpected(timeline.error());
  debugger->timeline_ = *std::move(timeline);
  debugger->stand_outermost();
  return debugger;
}

// --- breakpoints --------------------------------------------------------------------------------

Breakpoint& Debugger::add(Breakpoint breakpoint) {
  breakpoint.id = next_id_++;
  breakpoint.by_name =
      breakpoint.kind == Breakpoint::Kind::Sub && sources_.has_sub(breakpoint.text);
  return breakpoints_.emplace_back(std::move(breakpoint));
}

bool Debugger::remove(int id) {
  return std::erase_if(breakpoints_, [&](const Breakpoint& one) { return one.id == id; }) > 0;
}

void Debugger::remove_all(Breakpoint::Kind kind, std::optional<std::uint32_t> file) {
  std::erase_if(breakpoints_, [&](const Breakpoint& one) {
    return one.kind == kind && (!file || (!one.spots.empty() && one.spots.front().file == *file));
  });
}

// --- what happens -------------------------------------------------------------------------------

void Debugger::on_event(Duration, const vm::Event& event) {
  if (const auto* print = std::get_if<vm::event::Print>(&event))
    console_.print(print->text);
}

bool Debugger::event(const vm::Event& event) {
  const auto* error = std::get_if<vm::event::Error>(&event);
  const auto* input = error != nullptr ? sources_.input(timeline_->ball().basic_area()) : nullptr;
  if (input == nullptr)
    return false;
  fault_ = run::explain(*input, error->line, error->code, &timeline_->ball().machine());
  if (!stop_at_faults_)
    return false;
  found_ = {StopEvent::Reason::Fault, {}, fault_text(*fault_)};
  found_at_ = innermost();
  return true;
}

// --- going --------------------------------------------------------------------------------------

StopEvent Debugger::go(Move move, Direction direction, Thread thread, const GiveUp& give_up) {
  if (direction == Direction::Back && timeline_->drives())
    return {StopEvent::Reason::Robot, {}, std::string(no_way_back)};
  move_ = move;
  direction_ = direction;
  thread_ = thread;
  from_depth_ = depth(thread);
  until_ = Duration::max();
  how_ = Timeline::How::Begins;
  if (stops_within_line())
    return found_;
  return run(give_up);
}

/// True if the current move stops at another level of the line that is about to run.
bool Debugger::stops_within_line() {
  const auto* here = program_line();
  if (here == nullptr || timeline_->next() != Timeline::Next::Line)
    return false;
  const auto from = stands();
  const bool forward = direction_ == Direction::Forward;
  const auto count = forward ? here->levels.size() - 1 - from.at : from.at - from.first;
  found_ = {};
  before_ = nullptr;
  for (std::size_t n = 1; n <= count; ++n) {
    const auto level = forward ? from.at + n : from.at - n;
    if (!stops_at(*here, level, from.first + 1))
      continue;
    stand({from.first, level});
    return true;
  }
  return false;
}

StopEvent Debugger::go_until(Duration time, const GiveUp& give_up) {
  move_ = Move::Continue;
  direction_ = Direction::Forward;
  until_ = time;
  how_ = Timeline::How::Begins;
  if (stops_within_line())
    return found_;
  return run(give_up);
}

StopEvent Debugger::resume(const GiveUp& give_up) {
  return run(give_up);
}

StopEvent Debugger::run(const GiveUp& give_up) {
  const auto halt = direction_ == Direction::Forward
                        ? timeline_->forward(*this, until_, give_up, how_)
                        : timeline_->back(*this, give_up);
  how_ = Timeline::How::GoesOn;
  if (timeline_->ball().basic_running())
    fault_.reset();
  return stop_of(halt);
}

StopEvent Debugger::stop_of(Halt halt) {
  stand(innermost());
  switch (halt) {
  case Halt::Found:
    stand(direction_ == Direction::Forward ? found_at_ : noted_at_);
    return direction_ == Direction::Forward ? found_ : noted_;
  case Halt::Time: return {StopEvent::Reason::Time, {}, {}};
  case Halt::GivenUp: return {StopEvent::Reason::GivenUp, {}, {}};
  case Halt::Lost: return {StopEvent::Reason::Robot, {}, timeline_->lost()->message};
  case Halt::Over: break;
  }
  if (direction_ == Direction::Back) {
    stand_outermost();
    return {StopEvent::Reason::Begin, {}, {}};
  }
  if (timeline_->waits_for_number())
    return {StopEvent::Reason::Input, {}, {}};
  return {StopEvent::Reason::End, {}, fault_ ? fault_text(*fault_) : std::string()};
}

tl::expected<void, std::string> Debugger::restart() {
  if (timeline_->drives())
    return tl::unexpected(
        std::string("a robot cannot return to its start by itself: quit, put it on "
                    "its mark, and start again"));
  timeline_->begin_again();
  fault_.reset();
  is_helped_ = false;
  for (auto& one : breakpoints_)
    one.hits = 0;
  stand_outermost();
  return {};
}

/// Stops at the beginning of the run, before the calls that the first line belongs to.
void Debugger::stand_outermost() {
  const bool is_line = program_line() != nullptr && timeline_->next() == Timeline::Next::Line;
  stand(is_line ? Levels{0, 0} : innermost());
}

void Debugger::stand(Levels levels) {
  stands_ = levels;
  stands_when_ = timeline_->now();
}

Debugger::Levels Debugger::stands() const {
  return timeline_->now() == stands_when_ ? stands_ : innermost();
}

Debugger::Levels Debugger::innermost() const {
  const auto* here = program_line();
  const auto last = here == nullptr ? 0 : here->levels.size() - 1;
  return {last, last};
}

bool Debugger::jump(Spot spot) {
  for (const auto line : sources_.robot_lines(spot))
    if (timeline_->change(GoToLine{line})) {
      const auto* here = program_line();
      auto level = innermost().at;
      while (level > 0 && here->levels[level].spot != spot)
        --level;
      stand({level, level});
      return true;
    }
  return false;
}

bool Debugger::give_number(std::int32_t value) {
  is_helped_ = true;
  return timeline_->change(GiveNumber{value});
}

tl::expected<void, std::string> Debugger::happen(const vm::Stimulus& stimulus) {
  if (timeline_->drives())
    return tl::unexpected(std::string("do this to the robot by hand while the program runs"));
  is_helped_ = true;
  timeline_->change(stimulus);
  return {};
}

std::optional<run::Want> Debugger::want() const {
  return is_helped_ ? std::nullopt : run::want(inputs_, options_);
}

// --- looking ------------------------------------------------------------------------------------

const Sources::Line* Debugger::program_line() const {
  return sources_.line(timeline_->ball().basic_area(), robot_line());
}

int Debugger::robot_line() const {
  const auto& machine = timeline_->ball().machine();
  return fault_ && !machine.running() ? static_cast<int>(fault_->robot_line) : machine.line();
}

std::size_t Debugger::calls(Thread thread) const {
  const auto& ball = timeline_->ball();
  return thread == Thread::Program ? ball.machine().core().frames.call_depth
                                   : ball.macros().places().size();
}

Debugger::Depth Debugger::depth(Thread thread) const {
  return {calls(thread), thread == Thread::Program ? stands().at : 0};
}

bool Debugger::runs(Thread thread) const {
  const auto& ball = timeline_->ball();
  return thread == Thread::Program ? ball.basic_running() || fault_.has_value()
                                   : ball.macros().running();
}

Thread Debugger::thread() const {
  if (timeline_->next() == Timeline::Next::Line)
    return Thread::Program;
  if (timeline_->next() == Timeline::Next::Command)
    return Thread::Macro;
  return !runs(Thread::Program) && runs(Thread::Macro) ? Thread::Macro : Thread::Program;
}

std::vector<StackFrame> Debugger::frames(Thread thread) const {
  std::vector<StackFrame> all;
  const auto& ball = timeline_->ball();
  if (!runs(thread))
    return all;
  if (thread == Thread::Macro) {
    for (const auto& place : ball.macros().places())
      all.push_back(
          {sources_.macro_name(place.id), sources_.spot(place.id, place.command), place.command});
    return all;
  }
  const auto& core = ball.machine().core();
  const auto add = [&](int number, std::size_t hidden, bool main) {
    const auto* line = sources_.line(ball.basic_area(), number);
    if (line == nullptr)
      return all.push_back({main ? "main" : "gosub", std::nullopt, number});
    for (auto level = line->levels.size() - hidden; level-- > 0;) {
      const auto& one = line->levels[level];
      all.push_back({!one.sub.empty() ? one.sub : main ? "main" : "gosub", one.spot, number});
    }
  };
  const auto depth = core.frames.call_depth;
  const auto* here = program_line();
  add(robot_line(), here == nullptr ? 0 : here->levels.size() - 1 - stands().at, depth == 0);
  for (auto i = depth; i-- > 0;) {
    // The call is on the line before the one it returns to.
    const auto back = core.frames.calls[i];
    const auto& lines = core.chunk.lines;
    const auto after = std::lower_bound(
        lines.begin(), lines.end(), back,
        [](const bytecode::Line& line, std::uint32_t place) { return line.begin < place; });
    add(after == lines.begin() ? 0 : std::prev(after)->number, 0, i == 0);
  }
  return all;
}

std::optional<Spot> Debugger::spot() const {
  const auto all = frames(thread());
  return all.empty() ? std::nullopt : all.front().spot;
}

std::int32_t Debugger::sensor(spec::Variable variable) const {
  return timeline_->sensor(variable);
}

} // namespace orb::debug
