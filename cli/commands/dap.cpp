#include "editor/dap.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/wire.h"
#include "editor/wire.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <unistd.h>

namespace orb::cli {
namespace {

/// Serves until the client says `disconnect` or goes away.
ExitCode serve() {
  DiskFiles disk;
  std::error_code none;
  editor::DebugAdapter adapter(disk, std::filesystem::current_path(none).string());
  editor::MessageReader reader;
  std::array<char, 65536> bytes{};
  for (;;) {
    while (adapter.busy() && !client_speaks())
      send_all(adapter.work(client_speaks));
    const auto n = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return adapter.ended() ? ExitCode::Done : ExitCode::BadInput; // gone without a word
    reader.feed({bytes.data(), static_cast<std::size_t>(n)});
    while (const auto event = reader.next()) {
      send_all(event->is_error ? adapter.receive_garbage(event->text)
                               : adapter.receive(event->text));
      if (adapter.ended())
        return ExitCode::Done;
    }
  }
}

} // namespace

void add_dap(CLI::App& app, Context& context) {
  auto* command =
      add_command(app, "dap", "serve debuggers over stdin and stdout (Debug Adapter Protocol)",
                  "orb dap\n"
                  "orb dap --stdio");
  add_stdio_flag(*command);
  command->callback([&context] { context.exit = serve(); });
}

} // namespace orb::cli
