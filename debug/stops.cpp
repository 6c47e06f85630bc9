// Where a run stops. The timeline asks before each line and command, and after each motion step.

#include "debug/debugger.h"

#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::debug {

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
      ++found_at_.first; // the call began with an earlier line
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

/// The outermost level that begins with this line, given the previous line; the number of levels if
/// none does.
std::size_t Debugger::first_new(const Sources::Line& line) const {
  if (before_ == nullptr)
    return line.shared;
  if (calls(Thread::Program) > calls_before_)
    return 0;
  return std::max(line.shared, Sources::shared(*before_, line));
}

/// True if the previous line was at the same place of that level.
bool Debugger::goes_on(const Sources::Line& line, std::size_t level) const {
  return before_ != nullptr && Sources::shared(*before_, line) > level &&
         before_->levels[level].spot == line.levels[level].spot;
}

/// True if the previous line belongs to the same source line, in the same iteration.
bool Debugger::runs_on(const Sources::Line& line) const {
  return goes_on(line, line.levels.size() - 1) && before_->number < line.number &&
         before_->levels.size() == line.levels.size();
}

/// True if the run stops at one level of a line that is about to run.
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
  constexpr bool begins = true; // each command is a step of its own
  return steps_here(Thread::Macro, depth(Thread::Macro), begins) || stop;
}

bool Debugger::motion(Duration t) {
  moving_at_ = t;
  found_at_ = innermost();
  const bool stop = hit_values();
  moving_at_.reset();
  return stop;
}

/// True if the current step ends before this line or command.
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

/// Called when a sub begins.
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
    if (!value) // the variable does not exist here
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

/// Counts a hit; returns true if it stops the run.
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
  found_.reason = StopEvent::Reason::Breakpoint;
  found_.breakpoints.push_back(one.id);
  return true;
}

/// The text of a log point with the expressions in braces evaluated.
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

} // namespace orb::debug
