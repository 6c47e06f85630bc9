#include "vm/machine/machine.h"

#include "bytecode/arithmetic.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <utility>

namespace orb::vm {

namespace {

using bytecode::Op;
using spec::BasicError;
using spec::Limit;
using spec::Statement;
using spec::Variable;

constexpr std::int64_t second = Duration{1s}.count();
/// No product of a run's lines or time leaves 63 bits.
constexpr std::int64_t most_lines = 8'000'000'000;
constexpr std::int64_t greatest_product = 1'000'000'000 * most_lines; // below 2^63

/// A program becomes machine code when it has run so many lines for each of its instructions.
constexpr std::uint64_t runs_before_compiling = 200;
constexpr std::uint64_t never_compile = std::numeric_limits<std::uint64_t>::max();
/// In fewer lines than these, machine code does not earn what it costs to change to it.
constexpr std::int64_t fewest_native_lines = 30;
constexpr std::int64_t lines_to_pay_a_change = 8;
/// A program that hardly stays in machine code is left to the loop: in lines that it might have
/// won.
constexpr std::int64_t greatest_loss = -10'000;

constexpr auto print_bytes = static_cast<std::size_t>(spec::value_of(Limit::PrintBytes));
constexpr std::int32_t timer_values = spec::info(Variable::TimerA).greatest + 1;
/// What is printed in place of a text that is too long; no document has the robot's words [?].
constexpr std::string_view too_long = "(print exceeds 32 bytes)\n";

constexpr bool within(const spec::Parameter& parameter, std::int32_t value) {
  return parameter.least <= value && value <= parameter.greatest;
}

/// What a lenient ball makes of a value out of range; nothing: it stops at it, too.
std::optional<std::int32_t> bent(Statement statement, const spec::Parameter& parameter,
                                 std::int32_t value) {
  if (statement == Statement::Rgb)
    return std::clamp(value, parameter.least, parameter.greatest);
  if (parameter.unit != "deg" || value >= parameter.least)
    return std::nullopt;
  const auto turn = parameter.greatest + 1;
  return (value % turn + turn) % turn;
}

std::size_t timer_number(Variable variable) {
  return static_cast<std::size_t>(variable) - static_cast<std::size_t>(Variable::TimerA);
}

bool is_timer(Variable variable) {
  return variable == Variable::TimerA || variable == Variable::TimerB ||
         variable == Variable::TimerC;
}

/// Lamps change nothing that happens later, so the program need not pause for the ball to look.
bool only_lights(Statement statement) {
  return statement == Statement::Rgb || statement == Statement::Ledc ||
         statement == Statement::BackLed;
}

} // namespace

// --- slow operations
// ------------------------------------------------------------------------------

Then Core::read_system(const Code& instruction) {
  const auto variable = static_cast<Variable>(instruction.b);
  const Instant now = line_end();
  registers[instruction.a] = is_timer(variable) ? timer(variable, now) : host->read(variable, now);
  return Then::Next;
}

std::int32_t Core::timer(Variable variable, Instant now) const {
  const auto& timer = timers[timer_number(variable)];
  const std::int64_t elapsed = (now - timer.since) / std::chrono::milliseconds{1};
  return timer.from == 0
             ? static_cast<std::int32_t>(elapsed % timer_values)
             : static_cast<std::int32_t>(std::max<std::int64_t>(0, timer.from - elapsed));
}

Then Core::write_system(const Code& instruction) {
  const auto variable = static_cast<Variable>(instruction.a);
  const std::int32_t value = registers[instruction.b];
  if (!is_timer(variable)) {
    const auto problem = host->write(variable, value, line_end());
    return problem ? fail(*problem) : interrupted ? Then::Leave : Then::Next;
  }
  if (value < 0 || value >= timer_values)
    return fail(BasicError::BadNumericParameter);
  timers[timer_number(variable)] = {line_end(), value};
  return Then::Next;
}

Then Core::square_root(const Code& instruction) {
  const std::int32_t value = registers[instruction.b];
  if (value < 0)
    return fail(BasicError::BadNumericParameter);
  // 31 bits are exact in a double, and IEEE rounds the root correctly.
  registers[instruction.a] = static_cast<std::int32_t>(std::sqrt(static_cast<double>(value)));
  return Then::Next;
}

Then Core::random_number(const Code& instruction) {
  const std::int32_t most = registers[instruction.b];
  if (most < 1)
    return fail(BasicError::BadNumericParameter);
  const std::uint64_t drawn = random.next() >> 32;
  registers[instruction.a] =
      1 + static_cast<std::int32_t>(drawn * static_cast<std::uint64_t>(most) >> 32);
  return Then::Next;
}

void Core::print_number(std::int32_t value) {
  char digits[12];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  text.append(digits, end);
}

Then Core::print(PrintEnd end) {
  if (text.size() > print_bytes)
    text = too_long;
  else if (end == PrintEnd::Line)
    text += '\n';
  const Instant now = line_end();
  const auto again = host->print(text, now);
  if (!again) {
    text.clear();
    return Then::Leave; // whoever watches the output may want to stop here
  }
  pending = std::move(text);
  text.clear();
  wait = Wait::Queue;
  until = *again;
  return Then::Leave;
}

Then Core::delay(std::int32_t milliseconds) {
  if (!within(spec::info(Statement::Delay).parameters()[0], milliseconds))
    return fail(BasicError::BadNumericParameter);
  wait = Wait::Time;
  until = line_end() + std::chrono::milliseconds{milliseconds};
  return Then::Leave;
}

Then Core::input(const Code& instruction) {
  entry = instruction.a;
  wait = Wait::Input;
  until = never;
  return Then::Leave;
}

Then Core::input_timed(const Code& instruction) {
  const std::int32_t milliseconds = registers[instruction.b];
  if (!within(spec::info(Statement::Input).parameters()[0], milliseconds))
    return fail(BasicError::BadNumericParameter);
  entry = instruction.a;
  fallback = registers[instruction.c];
  wait = Wait::Input;
  until = line_end() + std::chrono::milliseconds{milliseconds};
  return Then::Leave;
}

Then Core::enter(std::int32_t value) {
  std::size_t index = entry;
  if (entry == bytecode::element_by_index) {
    const std::int32_t y = registers[bytecode::index_variable];
    if (y < 1 || y > bytecode::element_count)
      return fail(BasicError::IllegalIndex);
    index = bytecode::first_element + static_cast<std::size_t>(y) - 1;
  }
  registers[index] = value;
  return Then::Next;
}

Then Core::set_data(const Code& instruction) {
  data_count = instruction.b;
  data_next = 0;
  std::copy_n(registers.begin() + instruction.a, data_count, data.begin());
  return Then::Next;
}

Then Core::read_data(const Code& instruction) {
  if (data_next == data_count)
    return fail(BasicError::OutOfData);
  registers[instruction.a] = data[data_next++];
  return Then::Next;
}

Then Core::perform(const Code& instruction) {
  const auto statement = static_cast<Statement>(instruction.a);
  std::span<const std::int32_t> arguments{registers.data() + instruction.b, instruction.c};
  const auto parameters = spec::info(statement).parameters();
  std::array<std::int32_t, std::tuple_size_v<decltype(spec::StatementInfo::parameter_slots)>>
      taken{};
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (!within(parameters[i], arguments[i])) {
      const auto instead = ranges == spec::Ranges::Lenient
                               ? bent(statement, parameters[i], arguments[i])
                               : std::nullopt;
      if (!instead)
        return fail(BasicError::BadNumericParameter);
      if (arguments.data() != taken.data()) {
        std::copy(arguments.begin(), arguments.end(), taken.begin());
        arguments = {taken.data(), arguments.size()};
      }
      taken[i] = *instead;
    }
  if (const auto problem = host->perform(statement, arguments, line_end()))
    return fail(*problem);
  return only_lights(statement) && !interrupted ? Then::Next : Then::Leave;
}

void Core::reseed() {
  random.state = seeds.next();
}

void Core::clear() {
  std::fill_n(registers.begin(), bytecode::first_temporary, 0);
  frames.loops[0].variable = Frames::no_variable;
  frames.loop = frames.loops.data();
  frames.call_depth = 0;
  data_count = data_next = 0;
  text.clear();
  tron = false;
  timers.fill({line_end(), 0});
  reseed();
}

Then Core::trace() {
  tron = true;
  return Then::Leave;
}

Then Core::reset() {
  const Instant now = line_end();
  clear();
  pc = start;
  host->perform(Statement::Reset, {}, now);
  return Then::Leave;
}

// --- the machine
// ----------------------------------------------------------------------------------

Machine::Machine(std::uint32_t lines_per_second, std::uint64_t seed, Dispatch dispatch,
                 Native native, NativePrograms* shared)
    : engine_(dispatch == Dispatch::Threaded ? threaded_engine() : switch_engine()),
      native_(native), shared_(shared) {
  core_.lines_per_second =
      std::clamp<std::int64_t>(static_cast<std::int64_t>(lines_per_second), 1, second);
  core_.seeds.state = Random::mix(seed);
  core_.registers.resize(bytecode::first_temporary);
}

Machine::Machine(const Machine& other)
    : engine_(other.engine_), core_(other.core_), native_(other.native_), shared_(other.shared_),
      only_interpreted_(other.only_interpreted_), compile_at_(other.compile_at_),
      gain_(other.gain_), now_(other.now_), lines_(other.lines_),
      earlier_lines_(other.earlier_lines_), running_(other.running_), tracing_(other.tracing_),
      gate_(other.gate_), held_(other.held_), announced_(other.announced_),
      missing_line_(other.missing_line_), stop_(other.stop_) {
  const auto& from = other.core_;
  const auto same = [&](const Code* place) {
    return place == nullptr ? nullptr : core_.code.data() + from.index_of(place);
  };
  core_.pc = same(from.pc);
  core_.at = same(from.at);
  core_.start = same(from.start);
  if (from.frames.loop != nullptr)
    core_.frames.loop = core_.frames.loops.data() + (from.frames.loop - from.frames.loops.data());
  if (other.own_code_)
    compile_at_ = lines_before_compiling();
  else
    machine_code_ = other.machine_code_;
}

void Machine::link(bytecode::Chunk given) {
  core_.chunk = std::move(given);
  const auto& chunk = core_.chunk;
  const std::size_t size = chunk.code.size();
  core_.code.assign(size, {});
  core_.registers.assign(chunk.register_count(), 0);
  core_.reciprocals.assign(chunk.register_count(), 0);
  for (std::size_t i = 0; i < chunk.constants.size(); ++i) {
    const std::int32_t value = chunk.constants[i];
    core_.registers[chunk.first_constant() + i] = value;
    if (value > 2)
      core_.reciprocals[chunk.first_constant() + i] = bytecode::reciprocal(value);
  }

  const auto distance = [](std::size_t from, std::size_t to) {
    return static_cast<std::int32_t>(
        (static_cast<std::int64_t>(to) - static_cast<std::int64_t>(from)) *
        static_cast<std::int64_t>(sizeof(Code)));
  };
  std::size_t line = 0;
  for (std::size_t i = 0; i < size; ++i) {
    while (line < chunk.lines.size() && chunk.lines[line].begin <= i)
      ++line;
    const std::size_t following = line < chunk.lines.size() ? chunk.lines[line].begin : size - 1;
    const auto& instruction = chunk.code[i];
    core_.code[i] = {engine_.handlers[2 * static_cast<std::size_t>(instruction.op) +
                                      (instruction.ends_line ? 1 : 0)],
                     instruction.a,
                     instruction.b,
                     instruction.c,
                     instruction.d,
                     distance(i, instruction.target),
                     distance(i, following)};
  }
}

void Machine::start(bytecode::Chunk chunk, int line, Instant now) {
  if (bytecode::verify(chunk)) {
    chunk = {};
    chunk.code.push_back({Op::EndOfProgram});
  }
  link(std::move(chunk));
  now_ = core_.base = now;
  core_.done = core_.allowed = core_.budget = 0;
  core_.wait = Core::Wait::Nothing;
  core_.pending.clear();
  core_.clear();
  earlier_lines_ += lines_;
  lines_ = 0;
  machine_code_ = nullptr;
  own_code_.reset();
  only_interpreted_ = {};
  gain_ = 0;
  compile_at_ = lines_before_compiling();
  running_ = true;
  announced_ = false;
  stop_.reset();

  const auto found = std::find_if(core_.chunk.lines.begin(), core_.chunk.lines.end(),
                                  [&](const auto& row) { return row.number == line; });
  missing_line_.reset();
  if (found == core_.chunk.lines.end())
    missing_line_ = line;
  core_.start = core_.code.data() + (found == core_.chunk.lines.end() ? 0 : found->begin);
  core_.pc = core_.at = core_.start;
}

int Machine::line_of(const Code* code) const {
  const auto index = static_cast<std::uint32_t>(code - core_.code.data());
  const auto after =
      std::upper_bound(core_.chunk.lines.begin(), core_.chunk.lines.end(), index,
                       [](std::uint32_t place, const auto& line) { return place < line.begin; });
  return after == core_.chunk.lines.begin() ? 0 : std::prev(after)->number;
}

void Machine::finish(event::End::Reason reason) {
  running_ = false;
  stop_ = {reason, 0, std::nullopt, lines_};
}

void Machine::finish(BasicError error, int line) {
  running_ = false;
  stop_ = {event::End::Reason::Error, line, error, lines_};
}

std::optional<Machine::Stop> Machine::take_stop() {
  return std::exchange(stop_, std::nullopt);
}

void Machine::stop(event::End::Reason reason) {
  if (running_)
    finish(reason);
}

int Machine::line() const {
  const bool waits = core_.wait != Core::Wait::Nothing;
  return missing_line_ ? *missing_line_ : line_of(waits ? core_.at : core_.pc);
}

void Machine::abort() {
  if (!running_)
    return;
  finish(BasicError::UserAbort, line());
  stop_->reason = event::End::Reason::Abort;
}

std::int32_t Machine::timer(spec::Variable variable, Instant now) const {
  return is_timer(variable) ? core_.timer(variable, now) : 0;
}

bool Machine::go_to(int line, Instant now) {
  const auto found = std::find_if(core_.chunk.lines.begin(), core_.chunk.lines.end(),
                                  [&](const auto& row) { return row.number == line; });
  if (!running_ || found == core_.chunk.lines.end())
    return false;
  if (core_.wait != Core::Wait::Nothing)
    resume(std::max(now, now_));
  missing_line_.reset();
  announced_ = false;
  core_.pc = core_.at = core_.code.data() + found->begin;
  return true;
}

std::int32_t Machine::variable(std::size_t index) const {
  return core_.registers[index];
}

Instant Machine::next_event() const {
  if (!running_)
    return never;
  if (core_.wait != Core::Wait::Nothing)
    return core_.until;
  if (missing_line_ || core_.pc == &core_.code.back())
    return now_;
  return core_.time_of(core_.done + 1);
}

/// How many lines end before `limit`.
std::int64_t Machine::lines_before(Instant limit) const {
  const std::int64_t longest = greatest_product / core_.lines_per_second;
  const std::int64_t time = std::min((limit - core_.base).count(), longest);
  if (time <= 0)
    return 0;
  // Line k ends before it when k * 10^9 / N < time: all k below the quotient, rounded up.
  const std::int64_t last = (time * core_.lines_per_second + second - 1) / second - 1;
  return std::min(last - core_.done, most_lines);
}

void Machine::resume(Instant at) {
  core_.base += at - now_;
  now_ = at;
  core_.wait = Core::Wait::Nothing;
}

void Machine::deliver_input(std::int32_t value, Instant now) {
  if (!running_ || core_.wait != Core::Wait::Input)
    return;
  resume(std::max(now, now_));
  if (core_.enter(value) == Then::Fault)
    finish(core_.error, line_of(core_.at));
}

/// Ends what the program waits for, where that is before `limit`. True when it can go on.
bool Machine::continue_wait(Instant limit, Host& host) {
  if (core_.wait == Core::Wait::Nothing)
    return true;
  if (core_.until >= limit)
    return false;
  const auto wait = core_.wait;
  resume(core_.until);
  if (wait == Core::Wait::Input && core_.enter(core_.fallback) == Then::Fault) {
    finish(core_.error, line_of(core_.at));
    return false;
  }
  if (wait == Core::Wait::Queue) {
    if (const auto again = host.print(core_.pending, now_)) {
      core_.wait = wait;
      core_.until = *again;
      return continue_wait(limit, host);
    }
  }
  return true;
}

/// Prints the number of the next line for tron. True when the line can run.
bool Machine::announce(Host& host) {
  if (announced_ || !core_.tron)
    return true;
  announced_ = true;
  core_.pending = fmt::format("<{}>", line_of(core_.pc));
  const auto again = host.print(core_.pending, now_);
  if (again) {
    core_.wait = Core::Wait::Queue;
    core_.until = *again;
  }
  return !again;
}

/// The lines after which a program becomes machine code: what may be long to compile has run long.
std::uint64_t Machine::lines_before_compiling() const {
  if (native_ == Native::Off || (native_ == Native::Auto && !has_native_code()))
    return never_compile;
  return native_ == Native::On ? 0 : runs_before_compiling * core_.code.size();
}

void Machine::compile() {
  compile_at_ = never_compile;
  machine_code_ = shared_ ? shared_->find(core_.chunk) : nullptr;
  if (machine_code_)
    return;
  auto made = NativeCode::compile(core_.chunk);
  if (made)
    own_code_ = *std::move(made);
  else
    only_interpreted_ = made.error();
  machine_code_ = own_code_.get();
}

/// Runs what the budget allows as machine code, and one by one the lines that it does not know.
Exit Machine::run_native() {
  while (true) {
    const std::int64_t before = core_.budget;
    machine_code_->run(core_);
    if (core_.budget == 0)
      return Exit::Budget;
    if (core_.budget < NativeCode::longest_block)
      return engine_.run(core_);
    gain_ = std::min<std::int64_t>(0, gain_ + before - core_.budget - lines_to_pay_a_change);
    if (native_ == Native::Auto && gain_ < greatest_loss) {
      machine_code_ = nullptr;
      return engine_.run(core_);
    }
    const std::int64_t rest = core_.budget - 1;
    core_.allowed -= rest;
    core_.budget = 1;
    const Exit exit = engine_.run(core_);
    core_.allowed += rest;
    core_.budget += rest;
    if (exit != Exit::Budget)
      return exit;
  }
}

void Machine::run(Instant limit, Host& host) {
  core_.host = &host;
  core_.interrupted = held_ = false;
  if (running_ && missing_line_) {
    finish(BasicError::BadLineNumber, *missing_line_);
    return;
  }
  while (running_ && continue_wait(limit, host)) {
    if (core_.pc == &core_.code.back()) {
      finish(event::End::Reason::End);
      return;
    }
    std::int64_t lines = lines_before(limit);
    if (lines <= 0)
      return;
    if (lines_ >= compile_at_)
      compile();
    lines = static_cast<std::int64_t>(
        std::min(static_cast<std::uint64_t>(lines), compile_at_ - lines_));
    if (!announce(host))
      continue;
    if (gate_ != nullptr) {
      lines = std::min(lines, gate_->lines());
      held_ = lines == 0;
      if (held_)
        return;
    }
    const bool single = tracing_ || core_.tron;
    const int line = single ? line_of(core_.pc) : 0;
    core_.allowed = core_.budget = single ? 1 : lines;
    const bool pays = native_ == Native::On || lines >= fewest_native_lines;
    const Exit exit = machine_code_ && pays && !single ? run_native() : engine_.run(core_);
    const std::int64_t executed = core_.allowed - core_.budget;
    now_ = core_.line_end();
    lines_ += static_cast<std::uint64_t>(executed);
    core_.done += executed;
    core_.allowed = core_.budget = 0;
    // Whole seconds hold whole lines, so the numbers stay small.
    core_.base += std::chrono::seconds{core_.done / core_.lines_per_second};
    core_.done %= core_.lines_per_second;
    announced_ = false;
    if (tracing_ && executed > 0)
      host.line_ended(line, now_);

    switch (exit) {
    case Exit::Budget:
      if (core_.interrupted)
        return;
      break;
    case Exit::Leave: return;
    case Exit::Fault: finish(core_.error, line_of(core_.at)); return;
    case Exit::Ended: finish(event::End::Reason::End); return;
    }
  }
}

} // namespace orb::vm
