#include "editor/dap.h"

#include "base/duration.h"
#include "base/source.h"
#include "base/text.h"
#include "base/utf8.h"
#include "debug/debugger.h"
#include "debug/launch.h"
#include "debug/shell.h"
#include "editor/wording.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace orb::editor {
namespace {

using Answer = tl::expected<Json, std::string>;
using debug::Breakpoint;
using debug::Stop;
using debug::Thread;

bool flag_of(const Json& json, bool otherwise = false) {
  return json.is_boolean() ? json.get<bool>() : otherwise;
}

/// A whole number; nothing for anything else.
std::optional<std::int64_t> number_of(const Json& json) {
  if (!json.is_number_integer() ||
      (json.is_number_unsigned() && json.get<std::uint64_t>() > INT64_MAX))
    return std::nullopt;
  return json.get<std::int64_t>();
}

/// A list of texts; one text is a list of one.
std::vector<std::string> texts_of(const Json& json) {
  std::vector<std::string> all;
  if (json.is_string())
    all.push_back(json.get<std::string>());
  if (json.is_array())
    for (const auto& one : json)
      if (one.is_string())
        all.push_back(one.get<std::string>());
  return all;
}

tl::unexpected<std::string> refuse(std::string message) {
  return tl::unexpected(std::move(message));
}

// What clients call threads, scopes and frames by.
constexpr int program_thread = 1;
constexpr int macro_thread = 2;
constexpr std::int64_t frames_of_a_thread = 1000;
enum Reference : std::int64_t { Variables = 1, Arrays, Sensors, Ball, Limits, FirstArray = 100 };

int thread_number(Thread thread) {
  return thread == Thread::Program ? program_thread : macro_thread;
}

Thread thread_of(const Json& arguments) {
  return number_of(member(arguments, "threadId")) == macro_thread ? Thread::Macro : Thread::Program;
}

constexpr std::string_view fault_filter = "faults";

} // namespace

struct DebugAdapter::State final : debug::Console {
  State(structured::Files& from, std::string where, OpenRobot open)
      : files(from), folder(std::move(where)), open_robot(std::move(open)) {}

  structured::Files& files;
  std::string folder;
  OpenRobot open_robot;
  std::vector<std::string> out;
  std::int64_t seq = 0;

  // What the client has said of itself.
  bool initialized = false;
  std::int64_t first_line = 1;
  std::int64_t first_column = 1;

  std::unique_ptr<debug::Launched> launched;
  std::shared_ptr<run::HeldRobot> robot;     ///< that is driven; null for the virtual ball
  std::unique_ptr<debug::Debugger> debugger; ///< of `launched`
  bool stop_on_entry = false;
  bool stop_at_end = false;
  bool debugs = true; ///< false: it only runs
  bool configured = false;
  bool over = false; ///< the client was told that the run is
  bool ended = false;
  bool going = false;
  std::function<Stop(const debug::GiveUp&)> work; ///< how it goes on
  Stop stop;

  // debug::Console
  void print(std::string_view text) override { output("stdout", text); }
  void say(std::string_view text) override { output("console", std::string(text) + "\n"); }

  // Messages.
  void send(Json message) {
    message["seq"] = ++seq;
    out.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  void event(const char* name, Json body) {
    send({{"type", "event"}, {"event", name}, {"body", std::move(body)}});
  }
  void output(const char* category, std::string_view text) {
    event("output", {{"category", category}, {"output", to_valid_utf8(text)}});
  }
  void respond(const Json& request, const Answer& answer) {
    Json response{{"type", "response"},
                  {"request_seq", number_of(member(request, "seq")).value_or(0)},
                  {"command", text_of(member(request, "command"))},
                  {"success", answer.has_value()}};
    if (!answer)
      response["message"] = answer.error();
    else if (!answer->is_null())
      response["body"] = *answer;
    if (!answer)
      response["body"] = {{"error", {{"id", 1}, {"format", answer.error()}, {"showUser", true}}}};
    send(std::move(response));
  }

  void receive(std::string_view text);
  Answer request(const std::string& command, const Json& arguments);
  Answer look(const std::string& command, const Json& arguments);
  std::optional<Answer> move(const std::string& command, const Json& arguments);

  Answer initialize(const Json& arguments);
  Answer launch(const Json& arguments);
  tl::expected<std::shared_ptr<run::HeldRobot>, Failure> robot_at(const std::string& port,
                                                                  const std::string& kind);
  Answer configuration_done();
  Answer set_breakpoints(const Json& arguments);
  Json set_breakpoint(const Json& json, std::optional<std::uint32_t> file);
  Answer set_function_breakpoints(const Json& arguments);
  Answer set_data_breakpoints(const Json& arguments);
  Answer data_breakpoint_info(const Json& arguments);
  Answer threads();
  Answer stack_trace(const Json& arguments);
  Answer scopes(const Json& arguments);
  Answer completions(const Json& arguments);
  Answer variables(const Json& arguments);
  Answer set_variable(const Json& arguments);
  Answer evaluate(const Json& arguments);
  Answer console(std::string_view line);
  Answer goto_targets(const Json& arguments);
  Answer go_to(const Json& arguments);
  Answer exception_info();

  std::string absolute(const std::string& path) const {
    return path.empty() ? path : structured::resolve_path(folder + "/", path);
  }
  Json source(std::uint32_t file) const {
    const auto& name = debugger->sources().files()[file].name;
    return {{"name", file_name(name)}, {"path", absolute(name)}};
  }
  /// The file of the run that the client names; nothing where it is another.
  std::optional<std::uint32_t> file_of(const Json& source) const {
    const auto path = text_of(member(source, "path"));
    const auto& all = debugger->sources().files();
    for (std::uint32_t i = 0; i < all.size(); ++i)
      if (!path.empty() && absolute(all[i].name) == absolute(path))
        return i;
    return debugger->sources().file(path.empty() ? text_of(member(source, "name"))
                                                 : absolute(path));
  }
  std::optional<std::uint32_t> line_of(const Json& json) const {
    const auto number = number_of(json);
    if (!number || *number < first_line || *number > INT32_MAX)
      return std::nullopt;
    return static_cast<std::uint32_t>(*number - first_line + 1);
  }
  std::int64_t told_line(std::uint32_t line) const { return line - 1 + first_line; }

  void go(debug::Move move, debug::Direction direction, Thread thread) {
    proceed([this, move, direction, thread](const debug::GiveUp& give_up) {
      return debugger->go(move, direction, thread, give_up);
    });
  }
  void proceed(std::function<Stop(const debug::GiveUp&)> how) {
    work = std::move(how);
    going = true;
  }
  void stopped(const char* reason, const Stop& why, const std::string& description = {});
  void take(const Stop& why);
  void finish();
};

DebugAdapter::DebugAdapter(structured::Files& files, std::string folder, OpenRobot open_robot)
    : state_(std::make_unique<State>(files, std::move(folder), std::move(open_robot))) {}
DebugAdapter::~DebugAdapter() = default;

std::vector<std::string> DebugAdapter::receive(std::string_view message) {
  state_->receive(message);
  return std::exchange(state_->out, {});
}

std::vector<std::string> DebugAdapter::receive_garbage(std::string_view what) {
  state_->respond({}, refuse(std::string(what)));
  return std::exchange(state_->out, {});
}

bool DebugAdapter::busy() const {
  return state_->going;
}

bool DebugAdapter::ended() const {
  return state_->ended;
}

std::vector<std::string> DebugAdapter::work(const std::function<bool()>& interrupted) {
  constexpr std::size_t enough = 64; // messages before the client gets them
  if (state_->going) {
    const auto why = state_->work([&] { return state_->out.size() >= enough || interrupted(); });
    state_->work = [this](const debug::GiveUp& give_up) {
      return state_->debugger->resume(give_up);
    };
    if (why.reason != Stop::Reason::GivenUp)
      state_->take(why);
  }
  return std::exchange(state_->out, {});
}

void DebugAdapter::State::receive(std::string_view text) {
  const auto message = Json::parse(text, nullptr, false);
  if (message.is_discarded()) {
    respond({}, refuse("the message is not JSON"));
    return;
  }
  const auto type = text_of(member(message, "type"));
  if (type == "response") // nothing is asked of the client
    return;
  const auto command = text_of(member(message, "command"));
  if (type != "request" || command.empty()) {
    respond(message, refuse("the message is not a request that names a command"));
    return;
  }
  const bool launches = command == "launch" && debugger == nullptr;
  const auto answer = request(command, member(message, "arguments"));
  respond(message, answer);
  if (launches && answer && robot != nullptr)
    event("capabilities",
          {{"capabilities", {{"supportsStepBack", false}, {"supportsRestartRequest", false}}}});
  if (launches && answer)
    event("initialized", Json::object());
  if (command == "pause" && answer) {
    going = false;
    debugger->timeline().hold();
    stopped("pause", {});
  }
  if (command == "goto" && answer)
    stopped("goto", {});
  if (command == "restart" && answer && stop_on_entry)
    stopped("entry", {});
  if (command == "configurationDone" && answer && !going)
    stopped("entry", {});
  if (command == "terminate" && answer)
    finish();
}

Answer DebugAdapter::State::request(const std::string& command, const Json& arguments) {
  if (command == "disconnect") {
    going = false;
    ended = true;
    return Json();
  }
  if (command == "initialize")
    return initialize(arguments);
  if (!initialized)
    return refuse("the first request is `initialize`");
  if (command == "launch")
    return launch(arguments);
  if (command == "attach")
    return refuse("programs are run on a virtual ball: use `launch` with `program`");
  if (debugger == nullptr)
    return refuse(
        fmt::format("nothing is launched yet that `{}` could be about", to_valid_utf8(command)));
  if (command == "setBreakpoints")
    return set_breakpoints(arguments);
  if (command == "setFunctionBreakpoints")
    return set_function_breakpoints(arguments);
  if (command == "setDataBreakpoints")
    return set_data_breakpoints(arguments);
  if (command == "setExceptionBreakpoints") {
    const auto filters = texts_of(member(arguments, "filters"));
    debugger->stop_at_faults(debugs && std::find(filters.begin(), filters.end(), fault_filter) !=
                                           filters.end());
    return Json();
  }
  if (command == "configurationDone")
    return configuration_done();
  if (command == "threads")
    return threads();
  if (command == "terminate") {
    going = false;
    debugger->timeline().hold();
    return Json();
  }
  if (command == "restart") {
    if (!configured)
      return refuse("`configurationDone` comes before `restart`");
    if (auto again = debugger->restart(); !again)
      return refuse(again.error());
    over = false;
    going = false;
    if (!stop_on_entry)
      go(debug::Move::Continue, debug::Direction::Forward, Thread::Program);
    return Json();
  }
  if (command == "pause")
    return going ? Answer(Json()) : refuse("the program stands still already");
  if (command == "loadedSources") {
    auto list = Json::array();
    for (std::uint32_t i = 0; i < debugger->sources().files().size(); ++i)
      list.push_back(source(i));
    return Json{{"sources", std::move(list)}};
  }
  if (going || !configured)
    return refuse(
        going ? fmt::format("the program runs; `pause` comes before `{}`", to_valid_utf8(command))
              : fmt::format("`configurationDone` comes before `{}`", to_valid_utf8(command)));
  if (auto moved = move(command, arguments))
    return *std::move(moved);
  return look(command, arguments);
}

/// Requests that let the program go on; nothing for others.
std::optional<Answer> DebugAdapter::State::move(const std::string& command, const Json& arguments) {
  using debug::Direction;
  using debug::Move;
  struct Row {
    std::string_view command;
    Move move;
    Direction direction;
  };
  static constexpr Row rows[] = {
      {"continue", Move::Continue, Direction::Forward},
      {"next", Move::Over, Direction::Forward},
      {"stepIn", Move::In, Direction::Forward},
      {"stepOut", Move::Out, Direction::Forward},
      {"stepBack", Move::In, Direction::Back}, // the protocol has no other way back into a sub
      {"reverseContinue", Move::Continue, Direction::Back},
  };
  for (const auto& row : rows) {
    if (row.command != command)
      continue;
    if (over)
      return refuse("the run is over; `restart` begins it again");
    if (robot != nullptr && row.direction == Direction::Back)
      return refuse(std::string(debug::no_way_back));
    go(row.move, row.direction, thread_of(arguments));
    return command == "continue" ? Json{{"allThreadsContinued", true}} : Json();
  }
  return std::nullopt;
}

/// Requests about a run that stands still.
Answer DebugAdapter::State::look(const std::string& command, const Json& arguments) {
  if (command == "stackTrace")
    return stack_trace(arguments);
  if (command == "scopes")
    return scopes(arguments);
  if (command == "completions")
    return completions(arguments);
  if (command == "variables")
    return variables(arguments);
  if (command == "setVariable")
    return set_variable(arguments);
  if (command == "evaluate")
    return evaluate(arguments);
  if (command == "dataBreakpointInfo")
    return data_breakpoint_info(arguments);
  if (command == "gotoTargets")
    return goto_targets(arguments);
  if (command == "goto")
    return go_to(arguments);
  if (command == "exceptionInfo")
    return exception_info();
  return refuse(fmt::format("`{}` is not known here", to_valid_utf8(command)));
}

// --- beginning ----------------------------------------------------------------------------------

Answer DebugAdapter::State::initialize(const Json& arguments) {
  if (initialized)
    return refuse("`initialize` comes once");
  initialized = true;
  first_line = flag_of(member(arguments, "linesStartAt1"), true) ? 1 : 0;
  first_column = flag_of(member(arguments, "columnsStartAt1"), true) ? 1 : 0;
  Json can;
  for (const auto* name :
       {"supportsConfigurationDoneRequest", "supportsFunctionBreakpoints",
        "supportsConditionalBreakpoints", "supportsHitConditionalBreakpoints", "supportsLogPoints",
        "supportsDataBreakpoints", "supportsEvaluateForHovers", "supportsStepBack",
        "supportsSetVariable", "supportsGotoTargetsRequest", "supportsRestartRequest",
        "supportsCompletionsRequest", "supportsExceptionInfoRequest", "supportsTerminateRequest",
        "supportsLoadedSourcesRequest"})
    can[name] = true;
  can["exceptionBreakpointFilters"] =
      Json::array({{{"filter", fault_filter},
                    {"label", "Errors of the robot"},
                    {"description", "stops where an error of the robot ends the program"},
                    {"default", true}}});
  return can;
}

namespace {

/// What an argument of `launch` is not, though it should be; nothing where all fit.
std::optional<std::string> mistyped(const Json& arguments) {
  const auto is_text = [](const Json& json) { return json.is_string(); };
  const auto is_flag = [](const Json& json) { return json.is_boolean(); };
  const auto is_count = [](const Json& json) { return number_of(json).value_or(-1) >= 0; };
  const auto is_number = [](const Json& json) {
    const auto number = number_of(json);
    return number && *number == static_cast<std::int32_t>(*number);
  };
  const auto all = [](auto is) {
    return [is](const Json& json) {
      return json.is_array() && std::all_of(json.begin(), json.end(), is);
    };
  };
  const auto texts = all(is_text);
  const auto text_or_texts = [&](const Json& json) { return is_text(json) || texts(json); };
  const auto numbers = all(is_number);
  std::optional<std::string> wrong;
  const auto expect = [&](std::initializer_list<const char*> names, auto is, const char* what) {
    for (const auto* name : names)
      if (const auto& json = member(arguments, name); !wrong && !json.is_null() && !is(json))
        wrong = fmt::format("`{}` is {}", name, what);
  };
  expect({"program", "course", "test", "testName", "lang", "cwd", "port", "robot"}, is_text,
         "a text");
  expect({"files", "stimulus"}, text_or_texts, "a text or a list of texts");
  expect({"disconnected", "stopOnEntry", "stopAtEnd", "noDebug", "optimize"}, is_flag,
         "true or false");
  expect({"seed"}, is_count, "a whole number from 0");
  expect({"input"}, numbers, "a list of whole numbers");
  return wrong;
}

/// What a command line could do about it is said as an argument of `launch`.
std::string in_terms_of_launch(std::string message) {
  constexpr std::string_view option = "`--lang basic`, `--lang structured` or `--lang macro`";
  if (const auto at = message.find(option); at != std::string::npos)
    message.replace(at, option.size(),
                    R"(`"lang": "basic"`, `"lang": "structured"` or `"lang": "macro"`)");
  return message;
}

} // namespace

Answer DebugAdapter::State::launch(const Json& arguments) {
  if (debugger != nullptr)
    return refuse("a program is launched already");
  if (auto wrong = mistyped(arguments))
    return refuse(*std::move(wrong));
  const auto base = text_of(member(arguments, "cwd"));
  const auto path = [&](const std::string& given) {
    return given.empty() || given.front() == '/' || base.empty() ? given : base + "/" + given;
  };
  debug::Launch wanted;
  wanted.files.push_back(path(text_of(member(arguments, "program"))));
  for (const auto& file : texts_of(member(arguments, "files")))
    wanted.files.push_back(path(file));
  for (const auto& one : texts_of(member(arguments, "stimulus")))
    wanted.stimuli.push_back(vm::is_stimulus_line(one) ? one : path(one));
  wanted.course = path(text_of(member(arguments, "course")));
  wanted.test = path(text_of(member(arguments, "test")));
  wanted.test_name = text_of(member(arguments, "testName"));
  wanted.language = text_of(member(arguments, "lang"));
  if (const auto seed = number_of(member(arguments, "seed")))
    wanted.seed = static_cast<std::uint64_t>(*seed);
  for (const auto& one : member(arguments, "input"))
    wanted.numbers.push_back(one.get<std::int32_t>());
  if (const auto& optimize = member(arguments, "optimize"); optimize.is_boolean())
    wanted.shape =
        optimize.get<bool>() ? structured::Shape::Shortest : structured::Shape::Steppable;
  if (flag_of(member(arguments, "disconnected")))
    wanted.client = run::Client::Absent;
  if (wanted.files.front().empty()) {
    wanted.files.erase(wanted.files.begin());
    if (wanted.test.empty())
      return refuse("`launch` needs `program`: a file, or `test`: a test file");
  }
  auto read = debug::read(wanted, files);
  if (!read)
    return refuse(in_terms_of_launch(read.error().message));
  launched = *std::move(read);
  if (const auto port = text_of(member(arguments, "port")); !port.empty()) {
    auto opened = robot_at(port, text_of(member(arguments, "robot")));
    if (!opened)
      return refuse(opened.error().message);
    robot = *std::move(opened);
  }
  auto started = debug::Debugger::start(launched->inputs, launched->options, *this, robot.get());
  if (!started) {
    launched.reset();
    robot.reset();
    return refuse(started.error().message);
  }
  debugger = *std::move(started);
  debugs = !flag_of(member(arguments, "noDebug"));
  debugger->stop_at_faults(debugs);
  stop_on_entry = debugs && flag_of(member(arguments, "stopOnEntry"));
  stop_at_end = debugs && flag_of(member(arguments, "stopAtEnd"));
  return Json();
}

tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
DebugAdapter::State::robot_at(const std::string& port, const std::string& kind) {
  if (auto fits = debug::check_for_robot(*launched); !fits)
    return tl::unexpected(fits.error());
  if (!open_robot)
    return tl::unexpected(Failure{ExitCode::Usage, "robots are not reached from here: leave `port` "
                                                   "out"});
  return open_robot(port, kind);
}

Answer DebugAdapter::State::configuration_done() {
  if (configured)
    return refuse("`configurationDone` comes once");
  configured = true;
  if (!stop_on_entry)
    go(debug::Move::Continue, debug::Direction::Forward, Thread::Program);
  return Json();
}

// --- breakpoints --------------------------------------------------------------------------------

namespace {

/// Takes over what all kinds of breakpoints can say; what is wrong with it, or nothing.
std::optional<std::string> read_conditions(const debug::Debugger& debugger, const Json& json,
                                           Breakpoint& one) {
  if (const auto condition = text_of(member(json, "condition")); !trim(condition).empty()) {
    auto expression = debugger.expression(condition);
    if (!expression)
      return expression.error();
    one.only_if = *std::move(expression);
  }
  const auto hits = debug::HitCondition::parse(text_of(member(json, "hitCondition")));
  if (!hits)
    return hits.error();
  one.which = *hits;
  one.log = text_of(member(json, "logMessage"));
  return std::nullopt;
}

Json unverified(std::string why) {
  return {{"verified", false}, {"message", std::move(why)}};
}

} // namespace

Answer DebugAdapter::State::set_breakpoints(const Json& arguments) {
  const auto file = file_of(member(arguments, "source"));
  if (file)
    debugger->remove_all(Breakpoint::Kind::Line, *file);
  auto list = Json::array();
  const auto& wanted = member(arguments, "breakpoints");
  if (!wanted.is_array())
    return Json{{"breakpoints", std::move(list)}};
  for (const auto& json : wanted)
    list.push_back(set_breakpoint(json, file));
  return Json{{"breakpoints", std::move(list)}};
}

Json DebugAdapter::State::set_breakpoint(const Json& json, std::optional<std::uint32_t> file) {
  if (!file)
    return unverified("this file is not part of the run");
  const auto line = line_of(member(json, "line"));
  if (!line)
    return unverified("`line` is missing");
  Breakpoint one;
  if (auto wrong = read_conditions(*debugger, json, one))
    return unverified(*std::move(wrong));
  const auto runs = debugger->sources().runs(*file, *line);
  if (!runs)
    return unverified("nothing runs from this line on");
  if (!debugs)
    return unverified("it runs without a debugger");
  one.spots = {{*file, *runs}};
  one.text = debugger->sources().words(one.spots.front());
  return {{"id", debugger->add(std::move(one)).id},
          {"verified", true},
          {"source", source(*file)},
          {"line", told_line(*runs)}};
}

Answer DebugAdapter::State::set_function_breakpoints(const Json& arguments) {
  debugger->remove_all(Breakpoint::Kind::Sub);
  auto list = Json::array();
  const auto& wanted = member(arguments, "breakpoints");
  for (std::size_t i = 0; wanted.is_array() && i < wanted.size(); ++i) {
    Breakpoint one;
    one.kind = Breakpoint::Kind::Sub;
    one.text = trim(text_of(member(wanted[i], "name")));
    one.spots = debugger->sources().subs(one.text);
    const auto wrong = read_conditions(*debugger, wanted[i], one);
    if (one.spots.empty() || wrong || !debugs) {
      list.push_back(unverified(
          wrong ? *wrong
                : fmt::format("no sub that is called is named `{}`", to_valid_utf8(one.text))));
      continue;
    }
    const auto spot = one.spots.front();
    list.push_back({{"id", debugger->add(std::move(one)).id},
                    {"verified", true},
                    {"source", source(spot.file)},
                    {"line", told_line(spot.line)}});
  }
  return Json{{"breakpoints", std::move(list)}};
}

Answer DebugAdapter::State::data_breakpoint_info(const Json& arguments) {
  const auto name = text_of(member(arguments, "name"));
  const auto expression = debugger->expression(name);
  if (!expression)
    return Json{{"dataId", nullptr}, {"description", expression.error()}};
  return Json{{"dataId", expression->text()},
              {"description", expression->text()},
              {"accessTypes", {"write"}},
              {"canPersist", true}};
}

Answer DebugAdapter::State::set_data_breakpoints(const Json& arguments) {
  debugger->remove_all(Breakpoint::Kind::Change);
  debugger->remove_all(Breakpoint::Kind::Condition);
  auto list = Json::array();
  const auto& wanted = member(arguments, "breakpoints");
  for (std::size_t i = 0; wanted.is_array() && i < wanted.size(); ++i) {
    auto expression = debugger->expression(text_of(member(wanted[i], "dataId")));
    Breakpoint one;
    auto wrong = read_conditions(*debugger, wanted[i], one);
    const auto access = text_of(member(wanted[i], "accessType"));
    if (!wrong && !access.empty() && access != "write")
      wrong = fmt::format("reads are not watched, only changes; ask for `write`, not `{}`",
                          to_valid_utf8(access));
    if (!expression || wrong || !debugs) {
      list.push_back(unverified(!expression ? expression.error() : wrong.value_or("it only runs")));
      continue;
    }
    one.kind = expression->is_condition() ? Breakpoint::Kind::Condition : Breakpoint::Kind::Change;
    one.text = expression->text();
    one.expression = *std::move(expression);
    list.push_back({{"id", debugger->add(std::move(one)).id}, {"verified", true}});
  }
  return Json{{"breakpoints", std::move(list)}};
}

// --- looking ------------------------------------------------------------------------------------

Answer DebugAdapter::State::threads() {
  auto list = Json::array();
  const bool program = !over && debugger->runs(Thread::Program);
  const bool macro = !over && debugger->runs(Thread::Macro);
  if (program || !macro)
    list.push_back({{"id", program_thread}, {"name", "program"}});
  if (macro)
    list.push_back({{"id", macro_thread}, {"name", "macro"}});
  return Json{{"threads", std::move(list)}};
}

Answer DebugAdapter::State::stack_trace(const Json& arguments) {
  const auto thread = thread_of(arguments);
  const auto frames = debugger->frames(thread);
  const auto skipped = static_cast<std::size_t>(
      std::max<std::int64_t>(0, number_of(member(arguments, "startFrame")).value_or(0)));
  const auto wanted = std::max<std::int64_t>(0, number_of(member(arguments, "levels")).value_or(0));
  auto list = Json::array();
  for (std::size_t i = skipped; i < frames.size(); ++i) {
    if (wanted > 0 && list.size() == static_cast<std::size_t>(wanted))
      break;
    Json frame{{"id", thread_number(thread) * frames_of_a_thread + static_cast<std::int64_t>(i)},
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

Answer DebugAdapter::State::scopes(const Json& arguments) {
  const auto frame = number_of(member(arguments, "frameId"));
  if (!frame)
    return refuse("`frameId` is missing; `stackTrace` lists the frames");
  const auto is_of = [&](Thread thread) {
    const auto first = thread_number(thread) * frames_of_a_thread;
    const auto count = static_cast<std::int64_t>(debugger->frames(thread).size());
    return *frame >= first && *frame < first + count;
  };
  if (!is_of(Thread::Program) && !is_of(Thread::Macro))
    return refuse(fmt::format("there is no frame {} now; `stackTrace` lists them", *frame));
  auto list = Json::array();
  const auto add = [&](const char* name, std::int64_t reference, bool expensive) {
    list.push_back({{"name", name}, {"variablesReference", reference}, {"expensive", expensive}});
  };
  if (debugger->sources().input(debugger->timeline().ball().basic_area()) != nullptr) {
    add("Variables", Variables, false);
    if (!debugger->arrays().empty())
      add("Arrays", Arrays, false);
  }
  add("Ball", Ball, false);
  add("Sensors", Sensors, true);
  add("Loops and limits", Limits, true);
  return Json{{"scopes", std::move(list)}};
}

Answer DebugAdapter::State::variables(const Json& arguments) {
  const auto reference = number_of(member(arguments, "variablesReference")).value_or(0);
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

/// The byte at which column `column`, from 0 in UTF-16, begins; the end of the text behind it.
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

Answer DebugAdapter::State::completions(const Json& arguments) {
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

Answer DebugAdapter::State::set_variable(const Json& arguments) {
  const auto done =
      debugger->set(text_of(member(arguments, "name")), text_of(member(arguments, "value")));
  if (!done)
    return refuse(done.error());
  return Json{{"value", fmt::format("{}", *done)}};
}

Answer DebugAdapter::State::evaluate(const Json& arguments) {
  const auto text = text_of(member(arguments, "expression"));
  if (text_of(member(arguments, "context")) == "repl")
    if (auto done = console(trim(text)); done || !done.error().empty())
      return done;
  const auto value = debugger->evaluate(text);
  if (!value)
    return refuse(value.error());
  return Json{{"result", fmt::format("{}", *value)}, {"variablesReference", 0}};
}

/// A command of the debug console; an error without words where it is none.
Answer DebugAdapter::State::console(std::string_view line) {
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

Answer DebugAdapter::State::goto_targets(const Json& arguments) {
  const auto file = file_of(member(arguments, "source"));
  const auto line = line_of(member(arguments, "line"));
  auto list = Json::array();
  if (!file || !line)
    return Json{{"targets", std::move(list)}};
  const auto runs = debugger->sources().runs(*file, *line);
  if (runs && !debugger->sources().robot_lines({*file, *runs}).empty())
    list.push_back({{"id", (static_cast<std::int64_t>(*file) << 24) + *runs},
                    {"label", debugger->sources().words({*file, *runs})},
                    {"line", told_line(*runs)}});
  return Json{{"targets", std::move(list)}};
}

Answer DebugAdapter::State::go_to(const Json& arguments) {
  const auto id = number_of(member(arguments, "targetId")).value_or(-1);
  const auto file = static_cast<std::uint32_t>((id >> 24) & 0xFF);
  const auto line = static_cast<std::uint32_t>(id & 0xFFFFFF);
  if (id < 0 || file >= debugger->sources().files().size() || !debugger->jump({file, line}))
    return refuse("the program cannot go on there");
  return Json();
}

Answer DebugAdapter::State::exception_info() {
  const auto& fault = debugger->fault();
  if (!fault)
    return refuse("no error has stopped the program");
  return Json{{"exceptionId", std::string(spec::info(fault->code).text)},
              {"description", stop.text},
              {"breakMode", "always"}};
}

// --- standing still -----------------------------------------------------------------------------

void DebugAdapter::State::stopped(const char* reason, const Stop& why,
                                  const std::string& description) {
  stop = why;
  Json body{{"reason", reason},
            {"threadId", thread_number(debugger->thread())},
            {"allThreadsStopped", true}};
  if (!description.empty())
    body["description"] = description;
  if (!why.text.empty())
    body["text"] = to_valid_utf8(why.text);
  if (!why.breakpoints.empty())
    body["hitBreakpointIds"] = why.breakpoints;
  event("stopped", std::move(body));
}

void DebugAdapter::State::take(const Stop& why) {
  going = false;
  switch (why.reason) {
  case Stop::Reason::Step: return stopped("step", why);
  case Stop::Reason::Breakpoint: {
    const auto& all = debugger->breakpoints();
    const auto hit = std::find_if(all.begin(), all.end(), [&](const Breakpoint& one) {
      return one.id == why.breakpoints.front();
    });
    const auto kind = hit == all.end() ? Breakpoint::Kind::Line : hit->kind;
    return stopped(kind == Breakpoint::Kind::Line  ? "breakpoint"
                   : kind == Breakpoint::Kind::Sub ? "function breakpoint"
                                                   : "data breakpoint",
                   why);
  }
  case Stop::Reason::Fault: return stopped("exception", why, "Error of the robot");
  case Stop::Reason::Time: return stopped("pause", why, "Time reached");
  case Stop::Reason::GivenUp: return stopped("pause", why);
  case Stop::Reason::Robot: output("stderr", fmt::format("error: {}\n", why.text)); return finish();
  case Stop::Reason::Begin: return stopped("entry", why, "Beginning of the run");
  case Stop::Reason::Input:
    say("the program waits for a number; type `input 42` here");
    return stopped("pause", why, "Waits for a number");
  case Stop::Reason::End: break;
  }
  if (!why.text.empty())
    output("stderr", fmt::format("error: {}\n", why.text));
  say(debug::ending_of(*debugger));
  if (stop_at_end)
    return stopped("pause", why, "End of the run");
  finish();
}

void DebugAdapter::State::finish() {
  if (over)
    return;
  over = true;
  event("exited", {{"exitCode", debugger->fault() || debugger->timeline().lost() ? 1 : 0}});
  event("terminated", Json::object());
}

} // namespace orb::editor
