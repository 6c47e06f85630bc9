#include "editor/dap/session.h"

#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor::dap {

using debug::Breakpoint;

namespace {

/// Reads the members that all kinds of breakpoints share; returns what is wrong, or nothing.
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

Answer Session::set_breakpoints(const Json& arguments) {
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

Json Session::set_breakpoint(const Json& json, std::optional<std::uint32_t> file) {
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
    return unverified("this run has no debugger");
  one.spots = {{*file, *runs}};
  one.text = debugger->sources().words(one.spots.front());
  return {{"id", debugger->add(std::move(one)).id},
          {"verified", true},
          {"source", source(*file)},
          {"line", told_line(*runs)}};
}

Answer Session::set_function_breakpoints(const Json& arguments) {
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
          wrong ? *wrong : fmt::format("no sub `{}` is called", to_valid_utf8(one.text))));
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

Answer Session::data_breakpoint_info(const Json& arguments) {
  const auto name = text_of(member(arguments, "name"));
  const auto expression = debugger->expression(name);
  if (!expression)
    return Json{{"dataId", nullptr}, {"description", expression.error()}};
  return Json{{"dataId", expression->text()},
              {"description", expression->text()},
              {"accessTypes", {"write"}},
              {"canPersist", true}};
}

Answer Session::set_data_breakpoints(const Json& arguments) {
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
      list.push_back(unverified(!expression ? expression.error()
                                            : wrong.value_or("this run has no debugger")));
      continue;
    }
    one.kind = expression->is_condition() ? Breakpoint::Kind::Condition : Breakpoint::Kind::Change;
    one.text = expression->text();
    one.expression = *std::move(expression);
    list.push_back({{"id", debugger->add(std::move(one)).id}, {"verified", true}});
  }
  return Json{{"breakpoints", std::move(list)}};
}

Answer Session::set_exception_breakpoints(const Json& arguments) {
  const auto filters = texts_of(member(arguments, "filters"));
  debugger->stop_at_faults(debugs && std::find(filters.begin(), filters.end(), fault_filter) !=
                                         filters.end());
  return Json();
}

} // namespace orb::editor::dap
