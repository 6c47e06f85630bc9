#include "editor/dap/session.h"

#include "base/path.h"
#include "editor/wording.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor::dap {

Answer Session::initialize(const Json& arguments) {
  if (initialized)
    return refuse("`initialize` was already sent");
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
                    {"label", "Robot errors"},
                    {"description", "stops where a robot error ends the program"},
                    {"default", true}}});
  return can;
}

namespace {

/// Reports an argument of `launch` with the wrong type; nothing if all are right.
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
        wrong = fmt::format("`{}` must be {}", name, what);
  };
  expect({"program", "course", "test", "testName", "lang", "cwd", "port", "robot"}, is_text,
         "a string");
  expect({"files", "stimulus"}, text_or_texts, "a string or a list of strings");
  expect({"disconnected", "stopOnEntry", "stopAtEnd", "noDebug", "optimize"}, is_flag,
         "true or false");
  expect({"seed"}, is_count, "a whole number, 0 or greater");
  expect({"input"}, numbers, "a list of whole numbers");
  return wrong;
}

/// Rewords advice about command-line options as arguments of `launch`.
std::string in_terms_of_launch(std::string message) {
  constexpr std::string_view option = "`--lang basic`, `--lang structured` or `--lang macro`";
  if (const auto at = message.find(option); at != std::string::npos)
    message.replace(at, option.size(),
                    R"(`"lang": "basic"`, `"lang": "structured"` or `"lang": "macro"`)");
  return message;
}

/// Reads the program to start from the arguments of `launch`.
debug::Launch wanted_by(const Json& arguments) {
  const auto base = text_of(member(arguments, "cwd"));
  const auto path = [&](const std::string& given) {
    return given.empty() || is_absolute_path(given) || base.empty() ? given : base + "/" + given;
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
  return wanted;
}

} // namespace

Answer Session::launch(const Json& arguments) {
  if (debugger != nullptr)
    return refuse("a program is already launched");
  if (auto wrong = mistyped(arguments))
    return refuse(*std::move(wrong));
  auto wanted = wanted_by(arguments);
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
  afterwards = [this] {
    if (robot != nullptr)
      event("capabilities",
            {{"capabilities", {{"supportsStepBack", false}, {"supportsRestartRequest", false}}}});
    event("initialized", Json::object());
  };
  return Json();
}

Answer Session::attach(const Json&) {
  return refuse("programs are run on a virtual ball: use `launch` with `program`");
}

tl::expected<std::shared_ptr<run::HeldRobot>, Failure> Session::robot_at(const std::string& port,
                                                                         const std::string& kind) {
  if (auto fits = debug::check_for_robot(*launched); !fits)
    return tl::unexpected(fits.error());
  if (!open_robot)
    return tl::unexpected(Failure{ExitCode::Usage,
                                  "robots cannot be reached from here: leave `port` "
                                  "out"});
  return open_robot(port, kind);
}

Answer Session::begin() {
  if (stop_on_entry)
    afterwards = [this] { stopped("entry", {}); };
  else
    go(debug::Move::Continue, debug::Direction::Forward, Thread::Program);
  return Json();
}

Answer Session::configuration_done(const Json&) {
  if (configured)
    return refuse("`configurationDone` was already sent");
  configured = true;
  return begin();
}

Answer Session::restart(const Json&) {
  if (!configured)
    return refuse("send `configurationDone` before `restart`");
  if (auto again = debugger->restart(); !again)
    return refuse(again.error());
  over = false;
  going = false;
  return begin();
}

Answer Session::terminate(const Json&) {
  going = false;
  debugger->timeline().hold();
  afterwards = [this] { finish(); };
  return Json();
}

Answer Session::disconnect(const Json&) {
  going = false;
  ended = true;
  return Json();
}

} // namespace orb::editor::dap
