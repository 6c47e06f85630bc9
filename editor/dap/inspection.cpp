#include "editor/dap/session.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "debug/shell.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor::dap {

namespace {

// The ids of scopes and frames in the protocol.
constexpr std::int64_t frames_of_a_thread = 1000;
enum Reference : std::int64_t { Variables = 1, Arrays, Sensors, Ball, Limits, FirstArray = 100 };

/// A number as the client wrote it.
std::string shown(const Json& number) {
  return to_valid_utf8(number.dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace

bool Session::has(Thread thread) const {
  const bool macro = !over && debugger->runs(Thread::Macro);
  if (thread == Thread::Macro)
    return macro;
  return !macro || debugger->runs(Thread::Program);
}

tl::expected<Thread, std::string> Session::thread_of(const Json& arguments) const {
  const auto& id = member(arguments, "threadId");
  if (id.is_null())
    return Thread::Program;
  const auto number = number_of(id);
  for (const auto thread : {Thread::Program, Thread::Macro})
    if (number == thread_number(thread) && (has(thread) || thread == debugger->thread()))
      return thread;
  return refuse(fmt::format("there is no thread {} now; `threads` lists them", shown(id)));
}

bool Session::has_frame(std::int64_t frame) const {
  const auto is_of = [&](Thread thread) {
    const auto first = thread_number(thread) * frames_of_a_thread;
    const auto count = static_cast<std::int64_t>(debugger->frames(thread).size());
    return frame >= first && frame < first + count;
  };
  return is_of(Thread::Program) || is_of(Thread::Macro);
}

tl::expected<void, std::string> Session::check_frame(const Json& arguments) const {
  const auto& id = member(arguments, "frameId");
  const auto frame = number_of(id);
  if (id.is_null() || (frame && has_frame(*frame)))
    return {};
  return refuse(fmt::format("there is no frame {} now; `stackTrace` lists them", shown(id)));
}

bool Session::has_variables(std::int64_t reference) const {
  const auto arrays = static_cast<std::int64_t>(debugger->arrays().size());
  return (reference >= Variables && reference <= Limits) ||
         (reference >= FirstArray && reference - FirstArray < arrays);
}

Answer Session::threads(const Json&) {
  auto list = Json::array();
  if (has(Thread::Program))
    list.push_back({{"id", program_thread}, {"name", "program"}});
  if (has(Thread::Macro))
    list.push_back({{"id", macro_thread}, {"name", "macro"}});
  return Json{{"threads", std::move(list)}};
}

Answer Session::loaded_sources(const Json&) {
  auto list = Json::array();
  for (std::uint32_t i = 0; i < debugger->sources().files().size(); ++i)
    list.push_back(source(i));
  return Json{{"sources", std::move(list)}};
}

Answer Session::stack_trace(const Json& arguments) {
  const auto thread = thread_of(arguments);
  if (!thread)
    return refuse(thread.error());
  const auto frames = debugger->frames(*thread);
  const auto skipped = static_cast<std::size_t>(
      std::max<std::int64_t>(0, number_of(member(arguments, "startFrame")).value_or(0)));
  const auto wanted = std::max<std::int64_t>(0, number_of(member(arguments, "levels")).value_or(0));
  auto list = Json::array();
  for (std::size_t i = skipped; i < frames.size(); ++i) {
    if (wanted > 0 && list.size() == static_cast<std::size_t>(wanted))
      break;
    Json frame{{"id", thread_number(*thread) * frames_of_a_thread + static_cast<std::int64_t>(i)},
               {"name", to_valid_utf8(frames[i].name)},
               {"line", 0},
               {"column", 0}};
    if (const auto& spot = frames[i].spot) {
      frame["source"] = source(spot->file);
      frame["line"] = told_line(spot->line);
      frame["column"] = first_column;
    }
    list.push_back(std::move(frame));
  }
  return Json{{"stackFrames", std::move(list)}, {"totalFrames", frames.size()}};
}

Answer Session::scopes(const Json& arguments) {
  if (member(arguments, "frameId").is_null())
    return refuse("`frameId` is missing; `stackTrace` lists the frames");
  if (auto there = check_frame(arguments); !there)
    return refuse(there.error());
  auto list = Json::array();
  const auto add = [&](const char* name, std::int64_t reference) {
    const bool expensive = reference == Sensors || reference == Limits; // not opened unasked
    list.push_back({{"name", name}, {"variablesReference", reference}, {"expensive", expensive}});
  };
  if (debugger->sources().input(debugger->timeline().ball().basic_area()) != nullptr) {
    add("Variables", Variables);
    if (!debugger->arrays().empty())
      add("Arrays", Arrays);
  }
  add("Ball", Ball);
  add("Sensors", Sensors);
  add("Loops and limits", Limits);
  return Json{{"scopes", std::move(list)}};
}

Answer Session::variables(const Json& arguments) {
  const auto& id = member(arguments, "variablesReference");
  if (id.is_null())
    return refuse("`variablesReference` is missing; `scopes` lists them");
  const auto reference = number_of(id).value_or(0);
  if (!has_variables(reference))
    return refuse(fmt::format("there are no variables {}; `scopes` lists them", shown(id)));
  const auto arrays = debugger->arrays();
  auto list = Json::array();
  if (reference == Arrays)
    for (std::size_t i = 0; i < arrays.size(); ++i)
      list.push_back({{"name", arrays[i]},
                      {"value", fmt::format("{} elements", debugger->elements(arrays[i]).size())},
                      {"variablesReference", FirstArray + static_cast<std::int64_t>(i)}});
  const bool is_array =
      reference >= FirstArray && reference - FirstArray < static_cast<std::int64_t>(arrays.size());
  const auto all =
      reference == Variables ? debugger->variables()
      : reference == Sensors ? debugger->sensors()
      : reference == Ball    ? debugger->ball()
      : reference == Limits  ? debugger->limits()
      : is_array ? debugger->elements(arrays[static_cast<std::size_t>(reference - FirstArray)])
                 : std::vector<debug::Variable>();
  for (const auto& one : all) {
    const bool unit = reference != Variables && !one.note.empty();
    Json variable{{"name", to_valid_utf8(one.name)},
                  {"value", unit ? fmt::format("{} {}", one.value, one.note) : one.value},
                  {"variablesReference", 0}};
    if (one.register_ || reference == Sensors)
      variable["evaluateName"] = to_valid_utf8(one.name);
    if (reference == Variables && !one.note.empty())
      variable["type"] = fmt::format("in letter {}", one.note);
    list.push_back(std::move(variable));
  }
  return Json{{"variables", std::move(list)}};
}

namespace {

bool is_of_word(char c) {
  return is_letter(c) || is_digit(c) || c == '_';
}

/// The byte at column `column`, counted from 0 in UTF-16; past the end it is the end of the text.
std::size_t byte_at(std::string_view text, std::int64_t column) {
  std::size_t at = 0;
  while (at < text.size() && column > 0) {
    const auto lead = static_cast<unsigned char>(text[at]);
    const std::size_t size = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    at = std::min(at + size, text.size());
    column -= size == 4 ? 2 : 1;
  }
  return at;
}

} // namespace

Answer Session::completions(const Json& arguments) {
  if (auto there = check_frame(arguments); !there)
    return refuse(there.error());
  const auto text = text_of(member(arguments, "text"));
  const auto column = std::max<std::int64_t>(
      0, number_of(member(arguments, "column")).value_or(first_column) - first_column);
  const auto row = number_of(member(arguments, "line")).value_or(first_line) - first_line;
  std::string_view line = text;
  for (std::int64_t n = 0; n < row && line.find('\n') != std::string_view::npos; ++n)
    line.remove_prefix(line.find('\n') + 1);
  line = line.substr(0, byte_at(line, column));
  auto begin = line.size();
  while (begin > 0 && is_of_word(line[begin - 1]))
    --begin;
  const auto typed = line.substr(begin);
  const bool begins_line = trim(line.substr(0, begin)).empty();
  auto list = Json::array();
  const auto offer = [&](std::string_view word, const char* type) {
    if (word.size() >= typed.size() && equal_words(word.substr(0, typed.size()), typed))
      list.push_back({{"label", word},
                      {"type", type},
                      {"length", typed.size()},
                      {"start", column - static_cast<std::int64_t>(typed.size()) + first_column}});
  };
  for (const auto name : debugger->names())
    offer(name, "variable");
  for (const auto& sensor : spec::variables)
    offer(sensor.word, "property");
  for (const auto& function : spec::functions)
    offer(function.word, "function");
  if (begins_line) {
    for (const auto* word : {"until", "set"})
      offer(word, "keyword");
    for (const auto& event : vm::stimulus_words)
      offer(event.word, "keyword");
  }
  return Json{{"targets", std::move(list)}};
}

Answer Session::set_variable(const Json& arguments) {
  const auto& id = member(arguments, "variablesReference");
  if (!id.is_null() && !has_variables(number_of(id).value_or(0)))
    return refuse(fmt::format("there are no variables {}; `scopes` lists them", shown(id)));
  const auto done =
      debugger->set(text_of(member(arguments, "name")), text_of(member(arguments, "value")));
  if (!done)
    return refuse(done.error());
  return Json{{"value", fmt::format("{}", *done)}};
}

Answer Session::evaluate(const Json& arguments) {
  if (auto there = check_frame(arguments); !there)
    return refuse(there.error());
  const auto text = text_of(member(arguments, "expression"));
  if (text_of(member(arguments, "context")) == "repl")
    if (auto done = console(trim(text)); done || !done.error().empty())
      return done;
  const auto value = debugger->evaluate(text);
  if (!value)
    return refuse(value.error());
  return Json{{"result", fmt::format("{}", *value)}, {"variablesReference", 0}};
}

/// Runs a command of the debug console; fails without a message if it is not a command.
Answer Session::console(std::string_view line) {
  const auto [word, rest] = debug::split(line);
  const auto said = [](std::string text) {
    return Json{{"result", std::move(text)}, {"variablesReference", 0}};
  };
  if (word == "until") {
    const auto time = parse_duration(rest);
    if (!time || *time <= debugger->timeline().time())
      return refuse("`until` takes a time that is still to come: `until 3.5s`");
    proceed(
        [this, time](const debug::GiveUp& give_up) { return debugger->go_until(*time, give_up); });
    return said("");
  }
  if (const auto done = debug::change_by_words(*debugger, line))
    return *done ? Answer(said(**done)) : refuse(done->error());
  return refuse("");
}

Answer Session::exception_info(const Json& arguments) {
  if (const auto thread = thread_of(arguments); !thread)
    return refuse(thread.error());
  const auto& fault = debugger->fault();
  if (!fault)
    return refuse("no error has stopped the program");
  return Json{{"exceptionId", std::string(spec::info(fault->code).text)},
              {"description", stop.text},
              {"breakMode", "always"}};
}

} // namespace orb::editor::dap
