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

// --- what the timeline asks and tells ---------------------------------------------------------

void Debugger::on_event(Duration, const vm::Event& event) {
  if (const auto* print = std::get_if<vm::event::Print>(&event))
    console_.print(print->text);
}

void Debugger::begin() {
  found_ = {};
  const auto& machine = timeline_->ball().machine();
  const bool known = timeline_->next() == Timeline::Next::Line || machine.waits();
  before_ = known ? program_line() : nullptr;
  calls_before_ = calls(Thread::Program);
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
  found_at_ = innermost();
  bool stop = hit_values();
  if (here != nullptr) {
    const auto new_from = first_new(*here);
    const auto innermost_level = here->levels.size() - 1;
    const auto first = std::min(new_from == 0 ? 0 : new_from - 1, innermost_level);
    const bool forward = direction_ == Direction::Forward;
    found_at_ = {first, first};
    if (first < new_from && first < innermost_level && goes_on(*here, first))
      ++found_at_.first; // the call has begun with a line before
    for (auto n = first; n <= innermost_level && (!stop || n == first); ++n) {
      const auto level = forward ? n : innermost_level + first - n;
      if (!stops_at(*here, level, new_from))
        continue;
      found_at_.at = level;
      stop = true;
    }
  } else {
    stop = stop || move_ == Move::In;
  }
  before_ = here;
  calls_before_ = calls(Thread::Program);
  return stop;
}

/// The outermost level that begins with this line, now that another one has run before it; their
/// number where none does.
std::size_t Debugger::first_new(const Sources::Line& line) const {
  if (before_ == nullptr)
    return line.shared;
  if (calls(Thread::Program) > calls_before_)
    return 0;
  return std::max(line.shared, Sources::shared(*before_, line));
}

/// Whether the line before stood at the same place of that level.
bool Debugger::goes_on(const Sources::Line& line, std::size_t level) const {
  return before_ != nullptr && Sources::shared(*before_, line) > level &&
         before_->levels[level].spot == line.levels[level].spot;
}

/// Whether the line before is for the same line of the source, and this is not its next round.
bool Debugger::runs_on(const Sources::Line& line) const {
  return goes_on(line, line.levels.size() - 1) && before_->number < line.number &&
         before_->levels.size() == line.levels.size();
}

/// Whether the run stops at one level of a line that is about to run.
bool Debugger::stops_at(const Sources::Line& line, std::size_t level, std::size_t new_from) {
  const auto& here = line.levels[level];
  const bool is_new = level >= new_from;
  const bool own = level + 1 == line.levels.size();
  const bool begins = is_new || (own ? line.begins && !runs_on(line) : !goes_on(line, level));
  bool stop = begins && hit_place(here.spot);
  stop = (is_new && hit_sub(here.sub)) || stop;
  return steps_here(Thread::Program, {calls(Thread::Program), level}, begins) || stop;
}

bool Debugger::command() {
  const auto place = timeline_->ball().macros().places().front();
  found_ = {};
  found_at_ = innermost();
  bool stop = hit_values();
  if (const auto spot = sources_.spot(place.id, place.command))
    stop = hit_place(*spot) || stop;
  return steps_here(Thread::Macro, depth(Thread::Macro), true) || stop;
}

bool Debugger::motion(Duration t) {
  moving_at_ = t;
  found_at_ = innermost();
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
  found_at_ = innermost();
  return true;
}

/// Whether the step that is being made ends before this line or command.
bool Debugger::steps_here(Thread thread, Depth here, bool begins) {
  if (thread != thread_)
    return false;
  switch (move_) {
  case Move::Continue: return false;
  case Move::In: return begins;
  case Move::Over: return begins && here <= from_depth_;
  case Move::Out: return here < from_depth_;
  }
  return false;
}

bool Debugger::hit_place(Spot spot) {
  bool stop = false;
  for (auto& one : breakpoints_) {
    if (!one.by_name && std::find(one.spots.begin(), one.spots.end(), spot) != one.spots.end() &&
        counts(one))
      stop = true;
  }
  return stop;
}

/// A sub begins.
bool Debugger::hit_sub(std::string_view name) {
  bool stop = false;
  for (auto& one : breakpoints_)
    if (one.by_name && equal_words(one.text, name) && counts(one))
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
  if (forward && !one.which.holds(++one.hits))
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
  if (direction == Direction::Back && timeline_->drives())
    return {Stop::Reason::Robot, {}, std::string(no_way_back)};
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

/// Whether the way that is being gone stops at another level of the line that is about to run.
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

Stop Debugger::go_until(Duration time, const GiveUp& give_up) {
  move_ = Move::Continue;
  direction_ = Direction::Forward;
  until_ = time;
  how_ = Timeline::How::Begins;
  if (stops_within_line())
    return found_;
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
  stand(innermost());
  switch (halt) {
  case Halt::Found:
    stand(direction_ == Direction::Forward ? found_at_ : noted_at_);
    return direction_ == Direction::Forward ? found_ : noted_;
  case Halt::Time: return {Stop::Reason::Time, {}, {}};
  case Halt::GivenUp: return {Stop::Reason::GivenUp, {}, {}};
  case Halt::Lost: return {Stop::Reason::Robot, {}, timeline_->lost()->message};
  case Halt::Over: break;
  }
  if (direction_ == Direction::Back) {
    stand_outermost();
    return {Stop::Reason::Begin, {}, {}};
  }
  if (timeline_->waits_for_number())
    return {Stop::Reason::Input, {}, {}};
  return {Stop::Reason::End, {}, fault_ ? fault_text(*fault_) : std::string()};
}

tl::expected<void, std::string> Debugger::restart() {
  if (timeline_->drives())
    return tl::unexpected(std::string("a robot does not come back to its beginning by itself: end, "
                                      "put it on its mark, and begin again"));
  timeline_->begin_again();
  fault_.reset();
  is_helped_ = false;
  for (auto& one : breakpoints_)
    one.hits = 0;
  stand_outermost();
  return {};
}

/// At the beginning of the run: before the calls that the first line is for.
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
    return tl::unexpected(std::string("do it to the robot by hand while the program goes on"));
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
    // The call stands in the line before the one that it returns to.
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
  return fmt::format("unknown variable `{}`", name);
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
