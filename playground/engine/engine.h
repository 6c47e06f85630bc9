#pragma once

#include "editor/lsp/language_server.h"
#include "playground/engine/drives.h"
#include "playground/engine/request.h"
#include "playground/engine/robot.h"
#include "playground/engine/runs.h"
#include "playground/engine/uploads.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace orb::playground {

/// What answers requests. What lives from one to the next (the language server, a live run, an
/// upload, a robot that is driven) is kept here.
class Engine {
public:
  /// The answer to a request, both whole messages: `{"result":…}` or `{"error":…}`. Throws what the
  /// JSON library throws where the request, or a member of it, is not what it should be.
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
  template <Answer (*function)(Request&)>
  Answer plain(Request& request) {
    return function(request);
  }

  Said said_;
  MemoryFiles folder_;
  editor::LanguageServer server_{&folder_, &folder_, said_.say()};
  std::unique_ptr<Run> live_;
  std::optional<Upload> upload_;
  std::unique_ptr<Drive> drive_;
  RobotEar ear_;
};

/// A message that says why there is no answer.
std::string refusal(const Problem& problem);

} // namespace orb::playground
