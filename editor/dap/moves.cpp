#include "editor/dap/session.h"

#include "base/contain.h"
#include "base/text/utf8.h"
#include "debug/shell.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::editor::dap {

using debug::Breakpoint;

Answer Session::continue_all(const Json& arguments) {
  if (auto moved = move(debug::Move::Continue, debug::Direction::Forward, arguments); !moved)
    return moved;
  return Json{{"allThreadsContinued", true}};
}

Answer Session::next(const Json& arguments) {
  return move(debug::Move::Over, debug::Direction::Forward, arguments);
}

Answer Session::step_in(const Json& arguments) {
  return move(debug::Move::In, debug::Direction::Forward, arguments);
}

Answer Session::step_out(const Json& arguments) {
  return move(debug::Move::Out, debug::Direction::Forward, arguments);
}

/// The protocol has no other way to step back into a sub.
Answer Session::step_back(const Json& arguments) {
  return move(debug::Move::In, debug::Direction::Back, arguments);
}

Answer Session::reverse_continue(const Json& arguments) {
  return move(debug::Move::Continue, debug::Direction::Back, arguments);
}

Answer Session::move(debug::Move move, debug::Direction direction, const Json& arguments) {
  if (over)
    return refuse("the run is over; `restart` starts it again");
  if (robot != nullptr && direction == debug::Direction::Back)
    return refuse(std::string(debug::no_way_back));
  const auto thread = thread_of(arguments);
  if (!thread)
    return refuse(thread.error());
  go(move, direction, *thread);
  return Json();
}

Answer Session::pause(const Json&) {
  if (!going)
    return refuse("the program is already stopped");
  afterwards = [this] {
    going = false;
    debugger->timeline().hold();
    stopped("pause", {});
  };
  return Json();
}

Answer Session::goto_targets(const Json& arguments) {
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

Answer Session::go_to(const Json& arguments) {
  if (const auto thread = thread_of(arguments); !thread)
    return refuse(thread.error());
  const auto id = number_of(member(arguments, "targetId")).value_or(-1);
  const auto file = static_cast<std::uint32_t>((id >> 24) & 0xFF);
  const auto line = static_cast<std::uint32_t>(id & 0xFFFFFF);
  if (id < 0 || file >= debugger->sources().files().size() || !debugger->jump({file, line}))
    return refuse("the program cannot continue there");
  afterwards = [this] { stopped("goto", {}); };
  return Json();
}

void Session::go(debug::Move move, debug::Direction direction, Thread thread) {
  proceed([this, move, direction, thread](const debug::GiveUp& give_up) {
    return debugger->go(move, direction, thread, give_up);
  });
}

void Session::proceed(std::function<StopEvent(const debug::GiveUp&)> how) {
  work = std::move(how);
  going = true;
}

void Session::stopped(const char* reason, const StopEvent& why, const std::string& description) {
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

void Session::take(const StopEvent& why) {
  going = false;
  switch (why.reason) {
  case StopEvent::Reason::Step: return stopped("step", why);
  case StopEvent::Reason::Breakpoint: {
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
  case StopEvent::Reason::Fault: return stopped("exception", why, "Robot error");
  case StopEvent::Reason::Time: return stopped("pause", why, "Time reached");
  case StopEvent::Reason::GivenUp: return stopped("pause", why);
  case StopEvent::Reason::Robot:
    output("stderr", fmt::format("error: {}\n", why.text));
    return finish();
  case StopEvent::Reason::Begin: return stopped("entry", why, "Beginning of the run");
  case StopEvent::Reason::Input:
    say("the program is waiting for a number; type `input 42` here");
    return stopped("pause", why, "Waiting for a number");
  case StopEvent::Reason::End: break;
  }
  if (!why.text.empty())
    output("stderr", fmt::format("error: {}\n", why.text));
  say(debug::ending_of(*debugger));
  if (stop_at_end)
    return stopped("pause", why, "End of the run");
  finish();
}

void Session::finish() {
  if (over)
    return;
  over = true;
  event("exited", {{"exitCode", debugger->fault() || debugger->timeline().lost() ? 1 : 0}});
  event("terminated", Json::object());
}

/// Stops the robot first, then reports.
void Session::break_off(const std::string& why) {
  broken = true;
  going = false;
  if (robot != nullptr)
    static_cast<void>(contain([this] { return robot->hold(); }));
  output("stderr", why + "\n");
  event("exited", {{"exitCode", static_cast<int>(ExitCode::Bug)}});
  event("terminated", Json::object());
}

} // namespace orb::editor::dap
