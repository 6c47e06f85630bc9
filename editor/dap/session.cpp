#include "editor/dap/session.h"

#include "base/source.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace orb::editor::dap {

bool flag_of(const Json& json, bool otherwise) {
  return json.is_boolean() ? json.get<bool>() : otherwise;
}

std::optional<std::int64_t> number_of(const Json& json) {
  if (!json.is_number_integer() ||
      (json.is_number_unsigned() && json.get<std::uint64_t>() > INT64_MAX))
    return std::nullopt;
  return json.get<std::int64_t>();
}

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

int thread_number(Thread thread) {
  return thread == Thread::Program ? program_thread : macro_thread;
}

void Session::send(Json message) {
  message["seq"] = ++seq;
  out.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void Session::event(const char* name, Json body) {
  send({{"type", "event"}, {"event", name}, {"body", std::move(body)}});
}

void Session::output(const char* category, std::string_view text) {
  event("output", {{"category", category}, {"output", to_valid_utf8(text)}});
}

void Session::respond(const Json& request, const Answer& answer) {
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

void Session::receive(std::string_view text) {
  const auto message = Json::parse(text, nullptr, false);
  if (message.is_discarded()) {
    respond({}, refuse("the message is not JSON"));
    return;
  }
  const auto type = text_of(member(message, "type"));
  if (type == "response") // this adapter sends no requests
    return;
  const auto command = text_of(member(message, "command"));
  if (type != "request" || command.empty()) {
    respond(message, refuse("the message is not a request with a command"));
    return;
  }
  afterwards = nullptr;
  const auto answer = request(command, member(message, "arguments"));
  respond(message, answer);
  if (answer && afterwards)
    afterwards();
}

namespace {

/// The states in which a request is answered.
enum class When : std::uint8_t {
  Always, ///< even before `initialize`
  Initialized,
  Launched,   ///< a program is loaded
  StandsStill ///< a program is loaded and stopped
};

struct Row {
  std::string_view command;
  When when;
  Answer (Session::*answer)(const Json& arguments);
};

constexpr auto rows = std::to_array<Row>({
    {"disconnect", When::Always, &Session::disconnect},
    {"initialize", When::Always, &Session::initialize},
    {"launch", When::Initialized, &Session::launch},
    {"attach", When::Initialized, &Session::attach},
    {"setBreakpoints", When::Launched, &Session::set_breakpoints},
    {"setFunctionBreakpoints", When::Launched, &Session::set_function_breakpoints},
    {"setDataBreakpoints", When::Launched, &Session::set_data_breakpoints},
    {"setExceptionBreakpoints", When::Launched, &Session::set_exception_breakpoints},
    {"configurationDone", When::Launched, &Session::configuration_done},
    {"threads", When::Launched, &Session::threads},
    {"terminate", When::Launched, &Session::terminate},
    {"restart", When::Launched, &Session::restart},
    {"pause", When::Launched, &Session::pause},
    {"loadedSources", When::Launched, &Session::loaded_sources},
    {"continue", When::StandsStill, &Session::continue_all},
    {"next", When::StandsStill, &Session::next},
    {"stepIn", When::StandsStill, &Session::step_in},
    {"stepOut", When::StandsStill, &Session::step_out},
    {"stepBack", When::StandsStill, &Session::step_back},
    {"reverseContinue", When::StandsStill, &Session::reverse_continue},
    {"stackTrace", When::StandsStill, &Session::stack_trace},
    {"scopes", When::StandsStill, &Session::scopes},
    {"completions", When::StandsStill, &Session::completions},
    {"variables", When::StandsStill, &Session::variables},
    {"setVariable", When::StandsStill, &Session::set_variable},
    {"evaluate", When::StandsStill, &Session::evaluate},
    {"dataBreakpointInfo", When::StandsStill, &Session::data_breakpoint_info},
    {"gotoTargets", When::StandsStill, &Session::goto_targets},
    {"goto", When::StandsStill, &Session::go_to},
    {"exceptionInfo", When::StandsStill, &Session::exception_info},
});

/// Why a request is not allowed in this state; nothing if it is.
std::optional<std::string> obstacle(const Session& session, const std::string& command, When when) {
  if (when == When::Always)
    return std::nullopt;
  if (!session.initialized)
    return "the first request must be `initialize`";
  if (when == When::Initialized)
    return std::nullopt;
  const auto shown = to_valid_utf8(command);
  if (session.debugger == nullptr)
    return fmt::format("`{}` is not possible before a program is launched", shown);
  if (when == When::Launched)
    return std::nullopt;
  if (session.going)
    return fmt::format("the program is running; send `pause` before `{}`", shown);
  if (!session.configured)
    return fmt::format("send `configurationDone` before `{}`", shown);
  return std::nullopt;
}

} // namespace

Answer Session::request(const std::string& command, const Json& arguments) {
  const auto* const row = std::find_if(rows.begin(), rows.end(),
                                       [&](const Row& one) { return one.command == command; });
  const auto when = row == rows.end() ? When::StandsStill : row->when;
  if (auto why = obstacle(*this, command, when))
    return refuse(*std::move(why));
  if (row == rows.end())
    return refuse(fmt::format("unknown request `{}`", to_valid_utf8(command)));
  return (this->*row->answer)(arguments);
}

std::string Session::absolute(const std::string& path) const {
  return path.empty() ? path : structured::resolve_path(folder + "/", path);
}

Json Session::source(std::uint32_t file) const {
  const auto& name = debugger->sources().files()[file].name;
  return {{"name", file_name(name)}, {"path", absolute(name)}};
}

std::optional<std::uint32_t> Session::file_of(const Json& source) const {
  const auto path = text_of(member(source, "path"));
  const auto& all = debugger->sources().files();
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (!path.empty() && absolute(all[i].name) == absolute(path))
      return i;
  return debugger->sources().file(path.empty() ? text_of(member(source, "name")) : absolute(path));
}

std::optional<std::uint32_t> Session::line_of(const Json& json) const {
  const auto number = number_of(json);
  if (!number || *number < first_line || *number > INT32_MAX)
    return std::nullopt;
  return static_cast<std::uint32_t>(*number - first_line + 1);
}

} // namespace orb::editor::dap
