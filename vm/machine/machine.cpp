#include "vm/machine/machine.h"

#include "bytecode/arithmetic.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::vm {

namespace {

using bytecode::Op;
using spec::BasicError;

constexpr std::int64_t second = Duration{1s}.count();
/// Limits a run, so that products of lines and time fit 63 bits.
constexpr std::int64_t most_lines = 8'000'000'000;
constexpr std::int64_t greatest_product = 1'000'000'000 * most_lines; // below 2^63

} // namespace

Machine::Machine(std::uint32_t lines_per_second, std::uint64_t seed, Dispatch dispatch,
                 Native native, NativePrograms* shared)
    : engine_(dispatch == Dispatch::Threaded ? threaded_engine() : switch_engine()),
      native_(native, shared) {
  core_.lines_per_second =
      std::clamp<std::int64_t>(static_cast<std::int64_t>(lines_per_second), 1, second);
  core_.seeds.state = Random::mix(seed);
  core_.registers.resize(bytecode::first_temporary);
}

Machine::Machine(const Machine& other)
    : engine_(other.engine_), core_(other.core_), native_(other.native_), now_(other.now_),
      lines_(other.lines_), earlier_lines_(other.earlier_lines_), running_(other.running_),
      tracing_(other.tracing_), gate_(other.gate_), held_(other.held_),
      announced_(other.announced_), missing_line_(other.missing_line_),
      termination_(other.termination_) {
  const auto& from = other.core_;
  const auto same = [&](const Code* place) {
    return place == nullptr ? nullptr : core_.code.data() + from.index_of(place);
  };
  core_.pc = same(from.pc);
  core_.at = same(from.at);
  core_.start = same(from.start);
  if (from.frames.loop != nullptr)
    core_.frames.loop = core_.frames.loops.data() + (from.frames.loop - from.frames.loops.data());
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
  native_.begin(core_.code.size());
  running_ = true;
  announced_ = false;
  termination_.reset();

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
  termination_ = {reason, 0, std::nullopt, lines_};
}

void Machine::finish(BasicError error, int line) {
  running_ = false;
  termination_ = {event::End::Reason::Error, line, error, lines_};
}

std::optional<Machine::Termination> Machine::take_termination() {
  return std::exchange(termination_, std::nullopt);
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
  termination_->reason = event::End::Reason::Abort;
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

/// The number of lines that end before `limit`.
std::int64_t Machine::lines_before(Instant limit) const {
  const std::int64_t longest = greatest_product / core_.lines_per_second;
  const std::int64_t time = std::min((limit - core_.base).count(), longest);
  if (time <= 0)
    return 0;
  // Line k ends before `limit` if k * 10^9 / N < time, hence for all k below the quotient, rounded
  // up.
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

/// Ends a wait that is over before `limit`. Returns true if the program can continue.
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

/// Prints the number of the next line for tron. Returns true if the line can run.
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
    lines = native_.until_asked(lines, lines_, core_.chunk);
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
    const Exit exit = single ? engine_.run(core_) : native_.run(core_, engine_);
    const std::int64_t executed = core_.allowed - core_.budget;
    now_ = core_.line_end();
    lines_ += static_cast<std::uint64_t>(executed);
    core_.done += executed;
    core_.allowed = core_.budget = 0;
    // Move whole seconds into base, so that the numbers stay small. A second holds a whole number
    // of lines.
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
