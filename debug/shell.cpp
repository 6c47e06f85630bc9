#include "debug/shell.h"

#include "base/duration.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "debug/picture.h"
#include "report/svg.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::debug {
namespace {

tl::expected<std::string, std::string> said(std::string text) {
  return text;
}

tl::unexpected<std::string> wrong_because(std::string text) {
  return tl::unexpected(std::move(text));
}

} // namespace

Split split(std::string_view line) {
  line = trim(line);
  const auto blank = std::min(line.find_first_of(" \t"), line.size());
  return {line.substr(0, blank), trim(line.substr(blank))};
}

std::optional<tl::expected<std::string, std::string>> change_by_words(Debugger& debugger,
                                                                      std::string_view line) {
  const auto [word, rest] = split(line);
  if (word == "set") {
    const auto equals = rest.find('=');
    if (equals == std::string_view::npos)
      return wrong_because("write `set NAME = VALUE`");
    const auto done = debugger.set(rest.substr(0, equals), rest.substr(equals + 1));
    if (!done)
      return wrong_because(done.error());
    return said(fmt::format("{} is {}", trim(rest.substr(0, equals)), *done));
  }
  if (word == "input") {
    const auto number = parse_number<std::int32_t>(rest);
    if (!number)
      return wrong_because("write `input 42`");
    debugger.give_number(*number);
    return said(fmt::format("the next `input` gets {}", *number));
  }
  const auto script = vm::parse_stimulus(Source("console", fmt::format("at 0s {}\n", line)));
  if (!script.diagnostics.empty() || script.events.size() != 1)
    return std::nullopt;
  if (const auto done = debugger.happen(script.events.front().stimulus); !done)
    return wrong_because(done.error());
  return said(fmt::format("now: {}", trim(line)));
}

std::string ending_of(const Debugger& debugger) {
  run::Ending ending;
  ending.lasted = debugger.timeline().time();
  ending.lines = debugger.timeline().ball().machine().lines();
  return run::to_string(ending);
}

Shell::Shell(Debugger& debugger, Console& console, Write write)
    : debugger_(debugger), console_(console), write_(std::move(write)) {}

std::span<const Shell::Row> Shell::rows() {
  // clang-format off
  static constexpr Row table[] = {
      {"break",        "b",   "b LINE|FILE:LINE|SUB [if COND]", "stops before a line, or where a sub begins", &Shell::add_break},
      {"watch",        "w",   "watch EXPR",      "stops when a value changes, or a condition becomes true", &Shell::add_watch},
      {"log",          "",    "log LINE TEXT",   "prints text instead of stopping; `{EXPR}` in it is replaced by its value", &Shell::add_log},
      {"delete",       "d",   "d [NUMBER]",      "deletes a breakpoint, or all of them", &Shell::drop},
      {"continue",     "c",   "c",               "continues to the next breakpoint", &Shell::go_on, Repeats::Yes},
      {"step",         "s",   "s",               "goes to the next line, entering subs", &Shell::go<Move::In, Direction::Forward>, Repeats::Yes},
      {"next",         "n",   "n",               "goes to the next line in this sub", &Shell::go<Move::Over, Direction::Forward>, Repeats::Yes},
      {"finish",       "fin", "fin",             "continues until this sub has returned", &Shell::go<Move::Out, Direction::Forward>, Repeats::Yes},
      {"until",        "u",   "until TIME",      "continues to a time in the run: `until 3.5s`", &Shell::until},
      {"reverse-continue", "rc", "rc",           "goes back to the previous breakpoint", &Shell::go<Move::Continue, Direction::Back>, Repeats::Yes},
      {"reverse-step", "rs",  "rs",              "goes one line back, entering subs", &Shell::go<Move::In, Direction::Back>, Repeats::Yes},
      {"reverse-next", "rn",  "rn",              "goes one line back in this sub", &Shell::go<Move::Over, Direction::Back>, Repeats::Yes},
      {"goto",         "g",   "goto LINE",       "continues at another line", &Shell::jump},
      {"restart",      "r",   "r",               "goes back to the beginning and forgets what was changed", &Shell::again},
      {"print",        "p",   "p EXPR",          "prints a value: `p turns * 2`, `p xpos`, `p time`", &Shell::print},
      {"set",          "",    "set NAME = EXPR", "changes a variable", nullptr},
      {"input",        "",    "input NUMBER",    "gives `input` a number", nullptr},
      {"shake",        "",    "shake, push 90 120, …", "makes something happen to the ball now, as in stimulus scripts", nullptr},
      {"bt",           "",    "bt",              "prints where the program is and what called it", &Shell::trace},
      {"list",         "l",   "l [LINE]",        "prints the source around this line", &Shell::list},
      {"info",         "i",   "i [WHAT]",        "prints variables; `i ball`, `i sensors`, `i limits`, `i arrays`, `i breaks`", &Shell::info},
      {"path",         "",    "path [FILE.svg]", "draws the path so far", &Shell::path},
      {"help",         "h",   "help [COMMAND]",  "prints this", &Shell::help},
      {"quit",         "q",   "q",               "ends the debugger", &Shell::quit},
  };
  // clang-format on
  return table;
}

/// The command with this name, or the first with this prefix.
const Shell::Row* Shell::find(std::string_view word) const {
  const Row* found = nullptr;
  for (const auto& row : rows()) {
    if (row.word == word || (!row.alias.empty() && row.alias == word))
      return &row;
    if (!word.empty() && row.word.starts_with(word))
      found = found == nullptr ? &row : found;
  }
  return found;
}

void Shell::obey(std::string_view line, const GiveUp& give_up) {
  const std::string text(trim(line.empty() ? std::string_view(last_) : line));
  if (text.empty())
    return;
  const auto [word, rest] = split(text);
  const auto* row = find(word);
  if (row != nullptr && row->act != nullptr) {
    last_ = row->repeats == Repeats::Yes ? text : std::string();
    return (this->*row->act)(rest, give_up);
  }
  if (const auto done = change_by_words(debugger_, text))
    return console_.say(*done ? **done : done->error());
  std::vector<std::string_view> words;
  for (const auto& one : rows())
    words.push_back(one.word);
  wrong(fmt::format("`{}` is not a command; {}", word,
                    did_you_mean(word, words, "`help` lists them")));
}

// --- moving -------------------------------------------------------------------------------------

template <Move move, Direction direction>
void Shell::go(std::string_view, const GiveUp& give_up) {
  report(debugger_.go(move, direction, debugger_.thread(), give_up));
}

/// A program that waits for something nobody provides would run forever: reports that after a
/// while.
void Shell::go_on(std::string_view, const GiveUp& give_up) {
  constexpr Duration patience = std::chrono::seconds{60};
  const auto want = debugger_.want();
  if (!want)
    return report(debugger_.go(Move::Continue, Direction::Forward, debugger_.thread(), give_up));
  const auto stop = debugger_.go_until(debugger_.timeline().time() + patience, give_up);
  report(stop);
  if (stop.reason == StopEvent::Reason::Time)
    console_.say(fmt::format("{}; type `{}`, then `c`", want->lack, want->event));
}

void Shell::until(std::string_view rest, const GiveUp& give_up) {
  const auto time = parse_duration(rest);
  if (!time || *time <= debugger_.timeline().time())
    return wrong("write a time that is still to come: `until 3.5s`");
  report(debugger_.go_until(*time, give_up));
}

void Shell::jump(std::string_view rest, const GiveUp&) {
  const auto spot = spot_of(rest);
  if (!spot || !debugger_.jump(*spot))
    return wrong("the program cannot continue there");
  show_place();
}

void Shell::again(std::string_view, const GiveUp&) {
  if (const auto done = debugger_.restart(); !done)
    return wrong(done.error());
  show_place();
}

void Shell::report(const StopEvent& stop) {
  switch (stop.reason) {
  case StopEvent::Reason::Step:
  case StopEvent::Reason::Time: break;
  case StopEvent::Reason::Breakpoint:
    console_.say(fmt::format("breakpoint {}{}{}", stop.breakpoints.front(),
                             stop.text.empty() ? "" : ": ", stop.text));
    break;
  case StopEvent::Reason::Fault: console_.say(fmt::format("error: {}", stop.text)); break;
  case StopEvent::Reason::GivenUp:
    debugger_.timeline().hold();
    console_.say("interrupted");
    break;
  case StopEvent::Reason::Robot: return wrong(stop.text);
  case StopEvent::Reason::Input: console_.say("waiting for a number: `input 42`"); break;
  case StopEvent::Reason::End:
    if (!stop.text.empty())
      console_.say(fmt::format("error: {}", stop.text));
    console_.say(ending_of(debugger_) + (debugger_.timeline().drives() ? "" : "; `rs` goes back"));
    return;
  case StopEvent::Reason::Begin: console_.say("this is where the run began"); break;
  }
  show_place();
}

void Shell::show_place() {
  const auto spot = debugger_.spot();
  const double seconds = std::chrono::duration<double>(debugger_.timeline().time()).count();
  if (!spot)
    return console_.say(fmt::format("{:.3f} s", seconds));
  console_.say(fmt::format("{:.3f} s  {}  {}", seconds, debugger_.sources().words(*spot),
                           debugger_.sources().text(*spot)));
}

// --- breakpoints --------------------------------------------------------------------------------

/// Reads `12` or `hall.orb:12` and moves it to a line with code.
std::optional<Spot> Shell::spot_of(std::string_view text) const {
  const auto& sources = debugger_.sources();
  std::uint32_t file = debugger_.spot() ? debugger_.spot()->file : sources.main_file();
  if (const auto colon = text.rfind(':'); colon != std::string_view::npos) {
    const auto named = sources.file(text.substr(0, colon));
    if (!named)
      return std::nullopt;
    file = *named;
    text.remove_prefix(colon + 1);
  }
  const auto line = parse_number<std::uint32_t>(trim(text));
  const auto runs = line && *line > 0 ? sources.runs(file, *line) : std::nullopt;
  return runs ? std::optional(Spot{file, *runs}) : std::nullopt;
}

/// Why there is no place to stop at `text`.
std::string Shell::no_place(std::string_view text) const {
  const auto colon = text.rfind(':');
  if (colon != std::string_view::npos && !debugger_.sources().file(text.substr(0, colon)))
    return fmt::format("`{}` is not a file of this run", text.substr(0, colon));
  const auto line = trim(text.substr(colon == std::string_view::npos ? 0 : colon + 1));
  if (parse_number<std::uint32_t>(line))
    return fmt::format("nothing runs at line {} or below", line);
  return fmt::format("no sub `{}` is called", text);
}

void Shell::add_break(std::string_view rest, const GiveUp&) {
  Breakpoint one;
  if (const auto at = rest.find(" if "); at != std::string_view::npos) {
    auto condition = debugger_.expression(rest.substr(at + 4));
    if (!condition)
      return wrong(condition.error());
    one.only_if = *std::move(condition);
    rest = trim(rest.substr(0, at));
  }
  if (rest.empty() && debugger_.spot())
    one.spots = {*debugger_.spot()};
  else if (const auto spot = spot_of(rest))
    one.spots = {*spot};
  if (one.spots.empty()) {
    one.kind = Breakpoint::Kind::Sub;
    one.spots = debugger_.sources().subs(rest);
  }
  if (one.spots.empty())
    return wrong(no_place(rest));
  const auto spot = one.spots.front();
  one.text =
      one.kind == Breakpoint::Kind::Sub ? std::string(rest) : debugger_.sources().words(spot);
  const auto id = debugger_.add(std::move(one)).id;
  console_.say(fmt::format("breakpoint {}: {}  {}", id, debugger_.sources().words(spot),
                           debugger_.sources().text(spot)));
}

void Shell::add_watch(std::string_view rest, const GiveUp&) {
  auto expression = debugger_.expression(rest);
  if (!expression)
    return wrong(expression.error());
  Breakpoint one;
  one.kind = expression->is_condition() ? Breakpoint::Kind::Condition : Breakpoint::Kind::Change;
  one.text = expression->text();
  one.expression = *std::move(expression);
  const bool condition = one.kind == Breakpoint::Kind::Condition;
  const auto text = one.text;
  console_.say(fmt::format("breakpoint {}: {} {}", debugger_.add(std::move(one)).id,
                           condition ? "when" : "changes to", text));
}

void Shell::add_log(std::string_view rest, const GiveUp&) {
  const auto [place, text] = split(rest);
  const auto spot = spot_of(place);
  if (text.empty())
    return wrong("write `log LINE TEXT`");
  if (!spot)
    return wrong(no_place(place));
  Breakpoint one;
  one.spots = {*spot};
  one.log = text;
  one.text = debugger_.sources().words(*spot);
  console_.say(fmt::format("breakpoint {}: {} prints `{}`", debugger_.add(one).id, one.text, text));
}

void Shell::drop(std::string_view rest, const GiveUp&) {
  const auto id = parse_number<int>(rest);
  if (!rest.empty() && !id)
    return wrong("write `d NUMBER`; `i breaks` lists them");
  if (id && !debugger_.remove(*id))
    return wrong(fmt::format("there is no breakpoint {}; `i breaks` lists them", *id));
  if (!id)
    for (const auto all = debugger_.breakpoints(); const auto& one : all)
      debugger_.remove(one.id);
}

// --- looking ------------------------------------------------------------------------------------

void Shell::print(std::string_view rest, const GiveUp&) {
  const auto value = debugger_.evaluate(rest);
  console_.say(value ? fmt::format("{}", *value) : value.error());
}

void Shell::trace(std::string_view, const GiveUp&) {
  int depth = 0;
  for (const auto thread : {Thread::Program, Thread::Macro}) {
    if (debugger_.runs(thread) && thread != Thread::Program && debugger_.runs(Thread::Program))
      console_.say("macro:");
    for (const auto& frame : debugger_.frames(thread))
      console_.say(
          fmt::format("#{} {}{}{}", depth++, frame.name, frame.spot ? "  " : "",
                      frame.spot ? debugger_.sources().words(*frame.spot) : std::string()));
  }
}

void Shell::list(std::string_view rest, const GiveUp&) {
  constexpr std::uint32_t around = 5;
  auto here = debugger_.spot();
  auto middle = here;
  if (const auto line = parse_number<std::uint32_t>(rest))
    middle = Spot{here ? here->file : debugger_.sources().main_file(), *line};
  if (!middle)
    middle = Spot{debugger_.sources().main_file(), 1};
  const auto& source = *debugger_.sources().files()[middle->file].source;
  if (middle->line > source.line_count())
    return wrong(fmt::format("{} has {}", source.name(), plural(source.line_count(), "line")));
  const auto first = middle->line > around ? middle->line - around : 1;
  for (auto line = first; line <= std::min(middle->line + around, source.line_count()); ++line)
    console_.say(fmt::format("{} {:4}  {}", here == Spot{middle->file, line} ? '>' : ' ', line,
                             source.line(line)));
}

void Shell::show(const std::vector<Variable>& all) {
  for (const auto& one : all)
    console_.say(
        fmt::format("{} = {}{}{}", one.name, one.value, one.note.empty() ? "" : "  ", one.note));
}

/// `1: leg, hall.orb:3 if n = 2`.
std::string Shell::described(const Breakpoint& one) const {
  auto text = fmt::format("{}: {}", one.id, one.text);
  if (one.kind == Breakpoint::Kind::Sub)
    text += fmt::format(", {}", debugger_.sources().words(one.spots.front()));
  if (one.only_if)
    text += fmt::format(" if {}", one.only_if->text());
  if (!one.log.empty())
    text += fmt::format(" prints `{}`", one.log);
  return text;
}

void Shell::info(std::string_view rest, const GiveUp&) {
  const auto is = [&](std::string_view word) { return !rest.empty() && word.starts_with(rest); };
  if (is("ball"))
    return show(debugger_.ball());
  if (is("sensors"))
    return show(debugger_.sensors());
  if (is("limits"))
    return show(debugger_.limits());
  if (is("arrays")) {
    for (const auto& array : debugger_.arrays())
      show(debugger_.elements(array));
    return;
  }
  if (is("breaks")) {
    for (const auto& one : debugger_.breakpoints())
      console_.say(described(one));
    return;
  }
  if (!rest.empty() && !is("variables"))
    return wrong("`info` takes variables, arrays, ball, sensors, limits or breaks");
  show(debugger_.variables());
}

void Shell::path(std::string_view rest, const GiveUp&) {
  report::Journey journey;
  debugger_.timeline().tell(journey);
  if (rest.empty()) {
    const auto drawn = picture(journey);
    return console_.say(std::string_view(drawn).substr(0, drawn.size() - 1));
  }
  const auto written = write_(std::string(rest), report::path_svg(journey));
  if (!written)
    wrong(written.error());
}

void Shell::help(std::string_view rest, const GiveUp&) {
  const auto* one = rest.empty() ? nullptr : find(rest);
  for (const auto& row : rows())
    if (one == nullptr || one == &row)
      console_.say(fmt::format("{:32} {}{}", row.usage, row.summary,
                               row.alias.empty() || row.usage.starts_with(row.word)
                                   ? std::string()
                                   : fmt::format(" ({})", row.word)));
}

} // namespace orb::debug
