#include "cli/context/console.h"
#include "cli/editors/commands.h"
#include "cli/editors/stdio_wire.h"
#include "cli/input/inputs.h"
#include "cli/model/checks.h"
#include "cli/robot/driven_robot.h"
#include "cli/terminal/interrupt.h"
#include "editor/dap/debug_adapter.h"
#include "editor/wire.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace orb::cli {
namespace {

/// Connects the robot that `launch` names.
tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
robot_at(const Context& context, const std::string& port, const std::string& kind) {
  if (!kind.empty() && spec::find_robot(kind) == nullptr) {
    const auto names = names_of(spec::robots);
    const auto meant = meant_instead(kind, names);
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("`{}` is not a robot{}", kind,
                            meant.empty() ? fmt::format("; use one of {}", fmt::join(names, ", "))
                                          : meant)});
  }
  PortOptions options;
  options.port = port;
  return hold_robot(context, options, kind);
}

/// Serves until the client sends `disconnect` or closes the stream.
ExitCode serve_debugger(const Context& context) {
  const InterruptGuard guard; // the robot is restored on every way out
  DiskFiles disk;
  std::error_code none;
  editor::DebugAdapter adapter(disk, std::filesystem::current_path(none).generic_string(),
                               [&](const std::string& port, const std::string& kind) {
                                 return robot_at(context, port, kind);
                               });
  editor::MessageReader reader;
  std::array<char, 65536> bytes{};
  for (;;) {
    while (adapter.busy() && !client_speaks())
      send_all(adapter.work(client_speaks));
    if (adapter.broken())
      return ExitCode::Bug;
    const auto n = read_input(bytes);
    if (n < 0 && errno == EINTR && InterruptGuard::asked() == 0)
      continue;
    if (n <= 0)
      return adapter.ended() ? ExitCode::Done : ExitCode::BadInput; // closed without `disconnect`
    reader.feed({bytes.data(), static_cast<std::size_t>(n)});
    while (const auto event = reader.next()) {
      send_all(event->is_error ? adapter.receive_garbage(event->text)
                               : adapter.receive(event->text));
      if (adapter.broken())
        return ExitCode::Bug;
      if (adapter.ended())
        return ExitCode::Done;
    }
  }
}

} // namespace

void add_dap(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("dap", "serve debuggers over stdin and stdout (Debug Adapter Protocol)",
                      "orb dap\n"
                      "orb dap --stdio");
  add_stdio_flag(command);
  command.callback([&context] { context.exit = serve_debugger(context); });
}

} // namespace orb::cli
