#pragma once

#include "editor/lsp/language_server.h"
#include "playground/engine/drives.h"
#include "playground/engine/edu.h"
#include "playground/engine/floor.h"
#include "playground/engine/request.h"
#include "playground/engine/runs.h"
#include "playground/engine/trials.h"
#include "playground/engine/uploads.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace orb::playground {

/// Answers requests. Keeps what lasts from one to the next: the language server, a live run, an
/// upload, a driven robot. Large because each request of the page is a member, listed in one table.
class Engine {
public:
  /// Answers a request; both are whole messages: `{"result":…}` or `{"error":…}`. Passes on
  /// exceptions of the JSON library for malformed requests.
  [[gnu::noinline]] std::string answer(const char* request);

private:
  Answer call(const std::string& method, const ordered_json& params);
  using Method = Answer (Engine::*)(Request&);
  struct Row {
    std::string_view name;
    Method method;
  };
  static const Row rows[];

  Answer said(Request& request) { return print(request.said.take()); }
  Answer version(Request&) { return print({{"version", ORB_VERSION}}); }
  Answer files(Request& request);
  Answer lsp(Request& request);
  Answer run(Request& request);
  Answer live_start(Request& request);
  Answer live_advance(Request& request);
  Answer live_end(Request& request);
  Answer stimulus(Request& request);
  Answer input(Request& request);
  Answer report(Request& request);
  Answer deliver_start(Request& request);
  Answer deliver_step(Request& request);
  Answer drive_start(Request& request);
  Answer drive_step(Request& request);
  Answer hear_robot(Request& request) { return ear_.hear(request); }
  template <Answer (Floor::*function)(Request&)>
  Answer of_floor(Request& request) {
    return (floor_.*function)(request);
  }
  template <Answer (*function)(robot::Robot&, Request&)>
  Answer of_robot(Request& request) {
    const auto robot = floor_.find(request);
    return robot ? function(**robot, request) : Answer(tl::unexpected(robot.error()));
  }
  template <Answer (EduRuns::*function)(robot::Robot&, Request&)>
  Answer of_edu(Request& request) {
    const auto robot = floor_.find(request);
    return robot ? (edu_.*function)(**robot, request) : Answer(tl::unexpected(robot.error()));
  }
  Answer start_edu(Request& request) {
    const auto robot = floor_.find(request);
    if (!robot)
      return tl::unexpected(robot.error());
    auto answer = edu_.start(**robot, request);
    if (answer)
      trials_.begin(**robot);
    return answer;
  }
  Answer end_edu(Request& request) {
    const auto robot = floor_.find(request);
    return robot ? edu_.end(**robot, request, [&] { trials_.over(**robot); })
                 : Answer(tl::unexpected(robot.error()));
  }
  template <Answer (Trials::*function)(Request&)>
  Answer of_trials(Request& request) {
    return (trials_.*function)(request);
  }
  template <Answer (Trials::*function)(robot::Robot&, Request&)>
  Answer of_trial(Request& request) {
    const auto robot = floor_.find(request);
    return robot ? (trials_.*function)(**robot, request) : Answer(tl::unexpected(robot.error()));
  }
  Answer add_robot_of_trial(Request& request) { return trials_.add_robot(request, floor_); }
  Answer end_robot(Request& request) {
    const auto robot = floor_.find(request);
    edu_.forget(robot ? *robot : nullptr);
    trials_.forget(robot ? *robot : nullptr);
    return floor_.end(request);
  }
  template <Answer (*function)(Request&)>
  Answer plain(Request& request) {
    return function(request);
  }

  SentenceLog said_;
  MemoryFiles folder_;
  editor::LanguageServer server_{&folder_, &folder_, said_.say()};
  std::unique_ptr<Run> live_;
  std::optional<Upload> upload_;
  std::unique_ptr<Drive> drive_;
  RobotEar ear_;
  Floor floor_;
  EduRuns edu_;   ///< of robots of the floor
  Trials trials_; ///< the same
};

/// A message that says why the request failed.
std::string refusal(const Problem& problem);

} // namespace orb::playground
