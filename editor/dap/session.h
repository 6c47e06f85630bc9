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

/// The body of a response, or why there is none.
using Answer = tl::expected<Json, std::string>;
using debug::Stop;
using debug::Thread;

bool flag_of(const Json& json, bool otherwise = false);
/// A whole number; nothing for anything else.
std::optional<std::int64_t> number_of(const Json& json);
/// A list of texts; one text is a list of one.
std::vector<std::string> texts_of(const Json& json);
tl::unexpected<std::string> refuse(std::string message);

// What clients call threads by.
inline constexpr int program_thread = 1;
inline constexpr int macro_thread = 2;
int thread_number(Thread thread);

inline constexpr std::string_view fault_filter = "faults";

/// A client, its program and how far that has come.
struct Session final : debug::Console {
  Session(structured::Files& from, std::string where, DebugAdapter::OpenRobot open)
      : files(from), folder(std::move(where)), open_robot(std::move(open)) {}

  structured::Files& files;
  std::string folder;
  DebugAdapter::OpenRobot open_robot;
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
  bool broken = false; ///< by a bug: nothing is asked of it any more
  bool going = false;
  std::function<Stop(const debug::GiveUp&)> work; ///< how it goes on
  Stop stop;
  std::function<void()> afterwards; ///< what follows the response that is being made

  // debug::Console
  void print(std::string_view text) override { output("stdout", text); }
  void say(std::string_view text) override { output("console", std::string(text) + "\n"); }

  // Messages.
  void send(Json message);
  void event(const char* name, Json body);
  void output(const char* category, std::string_view text);
  void respond(const Json& request, const Answer& answer);
  void receive(std::string_view text);
  /// The answer to a request of any kind: by the rows in session.cpp.
  Answer request(const std::string& command, const Json& arguments);

  // The beginning and the end: launch.cpp.
  Answer initialize(const Json& arguments);
  Answer launch(const Json& arguments);
  Answer attach(const Json& arguments);
  Answer configuration_done(const Json& arguments);
  Answer begin(); ///< stops on entry, or goes
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

  // Going on and standing still: moves.cpp.
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
  void proceed(std::function<Stop(const debug::GiveUp&)> how);
  void take(const Stop& why);
  void stopped(const char* reason, const Stop& why, const std::string& description = {});
  void finish();
  void break_off(const std::string& why);

  // What can be seen and changed: inspection.cpp.
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

  // Files and lines, as the client counts them: session.cpp.
  std::string absolute(const std::string& path) const;
  Json source(std::uint32_t file) const;
  /// The file of the run that the client names; nothing where it is another.
  std::optional<std::uint32_t> file_of(const Json& source) const;
  std::optional<std::uint32_t> line_of(const Json& json) const;
  std::int64_t told_line(std::uint32_t line) const { return line - 1 + first_line; }

  // What the client names by numbers: inspection.cpp.
  bool has(Thread thread) const;
  bool has_frame(std::int64_t frame) const;
  /// The thread that the client names, the program where it names none; an error where there is no
  /// such thread.
  tl::expected<Thread, std::string> thread_of(const Json& arguments) const;
  /// An error where the client names a frame that there is not.
  tl::expected<void, std::string> check_frame(const Json& arguments) const;
  /// Whether `variables` lists something for this number.
  bool has_variables(std::int64_t reference) const;
};

} // namespace orb::editor::dap
