#include "cli/commands.h"
#include "cli/inputs.h"
#include "editor/language_server.h"
#include "editor/wire.h"

#include <array>
#include <cerrno>
#include <memory>
#include <unistd.h>

namespace orb::cli {
namespace {

void print_all(const std::vector<std::string>& messages) {
  for (const auto& message : messages)
    print_out(editor::frame(message));
}

/// Serves until the client says `exit` or goes away.
ExitCode serve() {
  DiskFiles disk;
  editor::LanguageServer server(&disk);
  editor::MessageReader reader;
  std::array<char, 65536> bytes{};
  for (;;) {
    const auto n = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return ExitCode::BadInput; // the client went away without a word
    reader.feed({bytes.data(), static_cast<std::size_t>(n)});
    while (const auto event = reader.next()) {
      print_all(event->is_error ? server.receive_garbage(event->text)
                                : server.receive(event->text));
      if (const auto well = server.ended_well())
        return *well ? ExitCode::Done : ExitCode::BadInput;
    }
  }
}

} // namespace

void add_lsp(CLI::App& app, Context& context) {
  auto* command =
      add_command(app, "lsp", "serve editors over stdin and stdout (Language Server Protocol)",
                  "orb lsp\n"
                  "orb lsp --stdio");
  auto stdio = std::make_shared<bool>(false);
  command->add_flag("--stdio", *stdio, "for editors that insist on it; it changes nothing");
  command->callback([&context, stdio] { context.exit = serve(); });
}

} // namespace orb::cli
