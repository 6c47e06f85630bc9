#include "debug/debugger.h"

#include "base/suggest.h"
#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace orb::debug {
namespace {

constexpr std::string_view time_word = "time";
constexpr std::string_view letter_words = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view array_word = "Z"; ///< of programs with line numbers

/// A letter's number where the name is one: A is 0, Y is 24.
std::optional<std::size_t> letter_of(std::string_view name) {
  if (name.size() != 1)
    return std::nullopt;
  const auto letter = static_cast<std::size_t>(std::toupper(static_cast<unsigned char>(name[0]))) -
                      static_cast<std::size_t>('A');
  return letter < letters ? std::optional(letter) : std::nullopt;
}

std::string fault_text(const run::ProgramError& fault) {
  std::string text(spec::info(fault.code).text);
  if (!fault.cause.seen.empty())
    text += fmt::format(": {}", fault.cause.seen);
  if (!fault.cause.variables.empty())
    text += fmt::format("; {}", fault.cause.variables);
  return text;
}

/// The symbol of a structured program that has that name, and is what is looked for; or null.
template <class Is>
const structured::Symbol* symbol_called(const structured::Compiled& compiled, std::string_view name,
                                        Is is) {
  for (const auto& symbol : compiled.names.symbols)
    if (is(symbol) && equal_words(compiled.program.name(symbol.name), name))
      return &symbol;
  return nullptr;
}

auto is_a(structured::SymbolKind kind) {
  return [kind](const structured::Symbol& symbol) { return symbol.kind == kind; };
}

} // namespace

Debugger::Debugger(std::span<const run::Input> inputs, const run::Options& options,
                   Console& console)
    : options_(options), console_(console), sources_(inputs, options) {}

Debugger::~Debugger() = default;

tl::expected<std::unique_ptr<Debugger>, Failure>
Debugger::start(std::span<const run::Input> inputs, const run::Options& options, Console& console) {
  std::unique_ptr<Debugger> debugger(new Debugger(inputs, options, console));
  auto timeline = Timeline::start(inputs, debugger->options_, *debugger);
  if (!timeline)
    return tl::unexpected(timeline.error());
  debugger->timeline_ = *std::move(timeline);
  return debugger;
}

tl::expected<Expression, std::string> Debugger::expression(std::string_view text) const {
  auto parsed = Expression::parse(text);
  if (!parsed)
    return parsed;
  const auto known = names();
  for (const auto name : parsed->names())
    if (std::none_of(known.begin(), known.end(),
                     [&](std::string_view one) { return equal_words(one, name); }))
      return tl::unexpected(
          fmt::format("there is no variable `{}`{}", name,
                      closest(name, known) ? "; " + did_you_mean(name, known, "") : ""));
  return parsed;
}

/// What an expression may name, here or elsewhere in the run.
std::vector<std::string_view> Debugger::names() const {
  std::vector<std::string_view> all{time_word};
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input != nullptr && input->program->compiled) {
    const auto& compiled = *input->program->compiled;
    for (const auto& symbol : compiled.names.symbols)
      if (!is_a(structured::SymbolKind::Sub)(symbol) &&
          !is_a(structured::SymbolKind::Function)(symbol))
        all.push_back(compiled.program.name(symbol.name));
  } else if (input != nullptr) {
    for (const auto& letter : letter_words)
      all.emplace_back(&letter, 1);
  }
  return all;
}

// --- breakpoints --------------------------------------------------------------------------------

Breakpoint& Debugger::add(Breakpoint breakpoint) {
  breakpoint.id = next_id_++;
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

// --- what the timeline asks and tells ---------------------------------------------------------

void Debugger::on_event(Duration, const vm::Event& event) {
  if (const auto* print = std::get_if<vm::event::Print>(&event))
    console_.print(print->text);
}

void Debugger::begin() {
  found_ = {};
  for (const auto& one : breakpoints_)
    if (one.expression) {
      values_.erase(one.id);
      if (const auto value = one.expression->value(*this))
        values_[one.id] = *value;
    }
}

bool Debugger::wants_lines() const {
  return move_ != Move::Continue || !breakpoints_.empty();
}

bool Debugger::line() {
  const auto* here = program_line();
  found_ = {};
  bool stop = hit_values();
  if (here == nullptr)
    return stop || move_ == Move::In;
  stop = (here->begins && hit_place(here->spot)) || stop;
  return steps_here(Thread::Program, here->begins) || stop;
}

bool Debugger::command() {
  const auto place = timeline_->ball().macros().places().front();
  found_ = {};
  bool stop = hit_values();
  if (const auto spot = sources_.spot(place.id, place.command))
    stop = hit_place(*spot) || stop;
  return steps_here(Thread::Macro, true) || stop;
}

bool Debugger::motion(Duration t) {
  moving_at_ = t;
  const bool stop = hit_values();
  moving_at_.reset();
  return stop;
}

bool Debugger::event(const vm::Event& event) {
  const auto* error = std::get_if<vm::event::Error>(&event);
  const auto* input = error != nullptr ? sources_.input(timeline_->ball().basic_area()) : nullptr;
  if (input == nullptr)
    return false;
  fault_ =
      run::explain(*input, options_.target, error->line, error->code, &timeline_->ball().machine());
  if (!stop_at_faults_)
    return false;
  found_ = {Stop::Reason::Fault, {}, fault_text(*fault_)};
  return true;
}

/// Whether the step that is being made ends before this line or command.
bool Debugger::steps_here(Thread thread, bool begins) {
  if (move_ == Move::Continue || thread != thread_)
    return false;
  const auto here = depth(thread);
  switch (move_) {
  case Move::Continue: return false;
  case Move::In: return begins;
  case Move::Over: return begins && here <= from_depth_;
  case Move::Out: return here < from_depth_ || (here == from_depth_ && sub() != from_sub_);
  }
  return false;
}

bool Debugger::hit_place(Spot spot) {
  bool stop = false;
  for (auto& one : breakpoints_)
    if (std::find(one.spots.begin(), one.spots.end(), spot) != one.spots.end() && counts(one))
      stop = true;
  return stop;
}

bool Debugger::hit_values() {
  bool stop = false;
  for (auto& one : breakpoints_) {
    if (!one.expression)
      continue;
    const auto value = one.expression->value(*this);
    if (!value) // the variable is not in use here
      continue;
    const auto known = values_.find(one.id);
    const bool first = known == values_.end();
    const std::int64_t before = first ? 0 : known->second;
    values_[one.id] = *value;
    const bool hit = one.kind == Breakpoint::Kind::Change ? !first && before != *value
                                                          : before == 0 && *value != 0;
    if (!hit || !counts(one))
      continue;
    stop = true;
    found_.text += fmt::format("{}{}", found_.text.empty() ? "" : "; ",
                               one.kind == Breakpoint::Kind::Change
                                   ? fmt::format("{} is {}, was {}", one.text, *value, before)
                                   : one.text);
  }
  return stop;
}

/// A breakpoint's place is reached: whether it stops the run.
bool Debugger::counts(Breakpoint& one) {
  if (one.only_if) {
    const auto holds = one.only_if->value(*this);
    if (holds && *holds == 0)
      return false;
    if (!holds)
      found_.text = fmt::format("`{}`: {}", one.only_if->text(), holds.error());
  }
  const bool forward = direction_ == Direction::Forward;
  if (forward && ++one.hits < one.from_hit)
    return false;
  if (!one.log.empty()) {
    if (forward)
      console_.say(filled(one.log));
    return false;
  }
  found_.reason = Stop::Reason::Breakpoint;
  found_.breakpoints.push_back(one.id);
  return true;
}

/// The text of a log point with the values of what stands in braces.
std::string Debugger::filled(std::string_view text) const {
  std::string out;
  while (!text.empty()) {
    const auto open = text.find('{');
    const auto close = text.find('}', open == std::string_view::npos ? open : open + 1);
    if (close == std::string_view::npos)
      break;
    out += text.substr(0, open);
    const auto value = evaluate(text.substr(open + 1, close - open - 1));
    out += value ? fmt::format("{}", *value) : fmt::format("({})", value.error());
    text.remove_prefix(close + 1);
  }
  return out += text;
}

// --- going --------------------------------------------------------------------------------------

Stop Debugger::go(Move move, Direction direction, Thread thread, const GiveUp& give_up) {
  move_ = move;
  direction_ = direction;
  thread_ = thread;
  from_depth_ = depth(thread);
  from_sub_ = sub();
  until_ = Duration::max();
  how_ = Timeline::How::Begins;
  return run(give_up);
}

Stop Debugger::go_until(Duration time, const GiveUp& give_up) {
  move_ = Move::Continue;
  direction_ = Direction::Forward;
  until_ = time;
  how_ = Timeline::How::Begins;
  return run(give_up);
}

Stop Debugger::resume(const GiveUp& give_up) {
  return run(give_up);
}

Stop Debugger::run(const GiveUp& give_up) {
  const auto halt = direction_ == Direction::Forward
                        ? timeline_->forward(*this, until_, give_up, how_)
                        : timeline_->back(*this, give_up);
  how_ = Timeline::How::GoesOn;
  if (timeline_->ball().basic_running())
    fault_.reset();
  return stop_of(halt);
}

Stop Debugger::stop_of(Halt halt) {
  switch (halt) {
  case Halt::Found: return direction_ == Direction::Forward ? found_ : noted_;
  case Halt::Time: return {Stop::Reason::Time, {}, {}};
  case Halt::GivenUp: return {Stop::Reason::GivenUp, {}, {}};
  case Halt::Over: break;
  }
  if (direction_ == Direction::Back)
    return {Stop::Reason::Begin, {}, {}};
  if (timeline_->waits_for_number())
    return {Stop::Reason::Input, {}, {}};
  return {Stop::Reason::End, {}, fault_ ? fault_text(*fault_) : std::string()};
}

void Debugger::restart() {
  timeline_->begin_again();
  fault_.reset();
  for (auto& one : breakpoints_)
    one.hits = 0;
}

bool Debugger::jump(Spot spot) {
  for (const auto line : sources_.robot_lines(spot))
    if (timeline_->change(GoToLine{line}))
      return true;
  return false;
}

// --- looking ------------------------------------------------------------------------------------

const Sources::Line* Debugger::program_line() const {
  return sources_.line(timeline_->ball().basic_area(), robot_line());
}

int Debugger::robot_line() const {
  const auto& machine = timeline_->ball().machine();
  return fault_ && !machine.running() ? static_cast<int>(fault_->robot_line) : machine.line();
}

std::string Debugger::sub() const {
  const auto* line = program_line();
  return line == nullptr ? std::string() : line->sub;
}

std::size_t Debugger::depth(Thread thread) const {
  const auto& ball = timeline_->ball();
  return thread == Thread::Program ? ball.machine().core().frames.call_depth
                                   : ball.macros().places().size();
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

std::vector<Frame> Debugger::frames(Thread thread) const {
  std::vector<Frame> all;
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
  const auto add = [&](int number, bool main) {
    const auto* line = sources_.line(ball.basic_area(), number);
    const bool named = line != nullptr && !line->sub.empty();
    all.push_back({named  ? line->sub
                   : main ? "main"
                          : "gosub",
                   line != nullptr ? std::optional(line->spot) : std::nullopt, number});
  };
  const auto depth = core.frames.call_depth;
  add(robot_line(), depth == 0);
  for (auto i = depth; i-- > 0;) {
    // The call stands in the line before the one that it returns to.
    const auto back = core.frames.calls[i];
    const auto& lines = core.chunk.lines;
    const auto after = std::lower_bound(
        lines.begin(), lines.end(), back,
        [](const bytecode::Line& line, std::uint32_t place) { return line.begin < place; });
    add(after == lines.begin() ? 0 : std::prev(after)->number, i == 0);
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

std::optional<std::size_t> Debugger::register_of(std::string_view name) const {
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input == nullptr)
    return std::nullopt;
  const auto& compiled = input->program->compiled;
  if (!compiled)
    return letter_of(name);
  const auto* line = program_line();
  for (std::size_t i = 0; line != nullptr && i < letters; ++i)
    if (line->symbols[i] != structured::none &&
        equal_words(compiled->program.name(compiled->names.symbols[line->symbols[i]].name), name))
      return i;
  return std::nullopt;
}

std::string Debugger::missing(std::string_view name) const {
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input != nullptr && input->program->compiled) {
    const auto any = [](const structured::Symbol&) { return true; };
    if (symbol_called(*input->program->compiled, name, any) != nullptr)
      return fmt::format("the robot does not hold `{}` here: it is not needed any more, or the "
                         "compiler knew its value",
                         name);
  }
  return fmt::format("there is no variable `{}` here", name);
}

std::optional<std::int32_t> Debugger::variable(std::string_view name) const {
  if (const auto found = register_of(name))
    return timeline_->ball().machine().variable(*found);
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input != nullptr && input->program->compiled) {
    const auto constant = is_a(structured::SymbolKind::Constant);
    if (const auto* found = symbol_called(*input->program->compiled, name, constant))
      return found->value;
  }
  if (equal_words(name, time_word))
    return static_cast<std::int32_t>((moving_at_ ? *moving_at_ : timeline_->time()) /
                                     std::chrono::milliseconds{1});
  if (input != nullptr && !input->program->compiled && equal_words(name, array_word))
    return element(name, timeline_->ball().machine().variable(bytecode::index_variable));
  return std::nullopt;
}

std::optional<std::size_t> Debugger::element_register(std::string_view name,
                                                      std::int32_t index) const {
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input == nullptr)
    return std::nullopt;
  std::int32_t base = 0;
  std::int32_t size = bytecode::element_count;
  if (input->program->compiled) {
    const auto* array =
        symbol_called(*input->program->compiled, name, is_a(structured::SymbolKind::Array));
    if (array == nullptr)
      return std::nullopt;
    base = array->base;
    size = array->value;
  } else if (!equal_words(name, array_word)) {
    return std::nullopt;
  }
  if (index < 1 || index > size)
    return std::nullopt;
  return bytecode::first_element + static_cast<std::size_t>(base + index - 1);
}

std::optional<std::int32_t> Debugger::element(std::string_view name, std::int32_t index) const {
  const auto found = element_register(name, index);
  return found ? std::optional(timeline_->ball().machine().variable(*found)) : std::nullopt;
}

tl::expected<std::int32_t, std::string> Debugger::evaluate(std::string_view text) const {
  const auto expression = Expression::parse(text);
  if (!expression)
    return tl::unexpected(expression.error());
  return expression->value(*this);
}

tl::expected<std::int32_t, std::string> Debugger::set(std::string_view name,
                                                      std::string_view value) {
  const auto number = evaluate(value);
  if (!number)
    return number;
  name = trim(name);
  auto place = register_of(name);
  if (const auto open = name.find('['); open != std::string_view::npos && name.ends_with(']')) {
    const auto index = evaluate(name.substr(open + 1, name.size() - open - 2));
    if (!index)
      return index;
    place = element_register(trim(name.substr(0, open)), *index);
  }
  if (!place)
    return tl::unexpected(missing(name));
  if (!timeline_->change(SetVariable{*place, *number}))
    return tl::unexpected(std::string("no program runs"));
  return *number;
}

} // namespace orb::debug
