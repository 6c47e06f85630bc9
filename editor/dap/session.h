#pragma once

#include "debug/debugger.h"
#include "debug/launch.h"
#include "editor/dap/debug_adapter.h"
#include "editor/wording.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::editor::dap {

/// The body of a response, or why the request failed.
using Answer = tl::expected<Json, std::string>;
using debug::StopEvent;
using debug::Thread;

bool flag_of(const Json& json, bool otherwise = false);
/// A whole number; nothing for anything else.
std::optional<std::int64_t> number_of(const Json& json);
/// Reads a list of texts; a single text is a list of one.
std::vector<std::string> texts_of(const Json& json);
tl::unexpected<std::string> refuse(std::string message);

// The ids of threads in the protocol.
inline constexpr int program_thread = 1;
inline constexpr int macro_thread = 2;
int thread_number(Thread thread);

inline constexpr std::string_view fault_filter = "faults";

/// A client with its program and the state of the run. Large because each request of the debug
/// adapter protocol is a member, listed in one table.
struct Session final : debug::Console {
  Session(structured::Files& from, std::string where, DebugAdapter::OpenRobot open)
      : files(from), folder(std::move(where)), open_robot(std::move(open)) {}

  structured::Files& files;
  std::string folder;
  DebugAdapter::OpenRobot open_robot;
  std::vector<std::string> out;
  std::int64_t seq = 0;

  // Announced by the client.
  bool initialized = false;
  std::int64_t first_line = 1;
  std::int64_t first_column = 1;

  std::unique_ptr<debug::Launched> launched;
  std::shared_ptr<run::HeldRobot> robot;     ///< driven robot; null for the virtual ball
  std::unique_ptr<debug::Debugger> debugger; ///< refers to `launched`
  bool stop_on_entry = false;
  bool stop_at_end = false;
  bool debugs = true; ///< false: runs without debugging
  bool configured = false;
  bool over = false; ///< the client knows that the run has ended
  bool ended = false;
  bool broken = false; ///< ended by a bug: takes no more requests
  bool going = false;
  std::function<StopEvent(const debug::GiveUp&)> work; ///< continues the run
  StopEvent stop;
  std::function<void()> afterwards; ///< runs after the current response is sent

  // debug::Console
  void print(std::string_view text) override { output("stdout", text); }
  void say(std::string_view text) override { output("console", std::string(text) + "\n"); }

  // Messages.
  void send(Json message);
  void event(const char* name, Json body);
  void output(const char* category, std::string_view text);
  void respond(const Json& request, const Answer& answer);
  void receive(std::string_view text);
  /// Answers any request, using the rows in session.cpp.
  Answer request(const std::string& command, const Json& arguments);

  // Start and end: launch.cpp.
  Answer initialize(const Json& arguments);
  Answer launch(const Json& arguments);
  Answer attach(const Json& arguments);
  Answer configuration_done(const Json& arguments);
  Answer begin(); ///< stops on entry, or runs
  Answer restart(const Json& arguments);
  Answer terminate(const Json& arguments);
  Answer disconnect(const Json& arguments);
  tl::expected<std::shared_ptr<run::HeldRobot>, Failure> robot_at(const std::string& port,
                                                                  const std::string& kind);

  // Breakpoints: breakpoints.cpp.
  Answer set_breakpoints(const Json& arguments);
  Answer set_function_breakpoints(const Json& arguments);
  Answer set_data_breakpoints(const Json& arguments);
  Answer set_exception_breakpoints(const Json& arguments);
  Answer data_breakpoint_info(const Json& arguments);
  Json set_breakpoint(const Json& json, std::optional<std::uint32_t> file);

  // Running and stopping: moves.cpp.
  Answer continue_all(const Json& arguments);
  Answer next(const Json& arguments);
  Answer step_in(const Json& arguments);
  Answer step_out(const Json& arguments);
  Answer step_back(const Json& arguments);
  Answer reverse_continue(const Json& arguments);
  Answer pause(const Json& arguments);
  Answer goto_targets(const Json& arguments);
  Answer go_to(const Json& arguments);
  Answer move(debug::Move move, debug::Direction direction, const Json& arguments);
  void go(debug::Move move, debug::Direction direction, Thread thread);
  void proceed(std::function<StopEvent(const debug::GiveUp&)> how);
  void take(const StopEvent& why);
  void stopped(const char* reason, const StopEvent& why, const std::string& description = {});
  void finish();
  void break_off(const std::string& why);

  // Inspecting and changing: inspection.cpp.
  Answer threads(const Json& arguments);
  Answer loaded_sources(const Json& arguments);
  Answer stack_trace(const Json& arguments);
  Answer scopes(const Json& arguments);
  Answer completions(const Json& arguments);
  Answer variables(const Json& arguments);
  Answer set_variable(const Json& arguments);
  Answer evaluate(const Json& arguments);
  Answer exception_info(const Json& arguments);
  Answer console(std::string_view line);

  // Files and lines in the client's terms: session.cpp.
  std::string absolute(const std::string& path) const;
  Json source(std::uint32_t file) const;
  /// The file of the run that the client means; nothing for other files.
  std::optional<std::uint32_t> file_of(const Json& source) const;
  std::optional<std::uint32_t> line_of(const Json& json) const;
  std::int64_t told_line(std::uint32_t line) const { return line - 1 + first_line; }

  // Ids in the client's requests: inspection.cpp.
  bool has(Thread thread) const;
  bool has_frame(std::int64_t frame) const;
  /// The thread in a request, the program if it names none; fails for an unknown thread.
  tl::expected<Thread, std::string> thread_of(const Json& arguments) const;
  /// Fails if the client names an unknown frame.
  tl::expected<void, std::string> check_frame(const Json& arguments) const;
  /// True if this is a reference that `variables` can list.
  bool has_variables(std::int64_t reference) const;
};

} // namespace orb::editor::dap
