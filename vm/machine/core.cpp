#include "vm/machine/core.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

namespace orb::vm {

namespace {

using spec::BasicError;
using spec::Limit;
using spec::Statement;
using spec::Variable;

constexpr auto print_bytes = static_cast<std::size_t>(spec::value_of(Limit::PrintBytes));
constexpr std::int32_t timer_values = spec::info(Variable::TimerA).greatest + 1;
/// Printed instead of a text that is too long. No document gives the robot's wording [?].
constexpr std::string_view too_long = "(print exceeds 32 bytes)\n";

constexpr bool within(const spec::Parameter& parameter, std::int32_t value) {
  return parameter.least <= value && value <= parameter.greatest;
}

/// Returns what a lenient ball makes of a value out of range; nullopt if it refuses the
/// value too.
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

/// Lamps affect no later event, so the program need not pause for the ball.
bool only_lights(Statement statement) {
  return statement == Statement::Rgb || statement == Statement::Ledc ||
         statement == Statement::BackLed;
}

} // namespace

bool is_timer(Variable variable) {
  return variable == Variable::TimerA || variable == Variable::TimerB ||
         variable == Variable::TimerC;
}

// --- slow operations ------------------------------------------------------------------------

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
  // A double holds 31 bits exactly, and IEEE rounds the root correctly.
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
    return Then::Leave; // an observer of the output may want to stop here
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

} // namespace orb::vm
