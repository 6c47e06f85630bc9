#include "cli/context/console.h"
#include "cli/editors/commands.h"
#include "cli/editors/stdio_wire.h"
#include "cli/input/inputs.h"
#include "disk/disk.h"
#include "editor/lsp/language_server.h"
#include "editor/wire.h"
#include "run/input.h"
#include "testing/suite.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>

namespace orb::cli {
namespace {

/// The files in the editor's workspace folders.
class DiskFolders final : public editor::Folders {
public:
  std::vector<std::string> sources(const std::string& root) override {
    constexpr std::size_t most_files = 500;
    constexpr std::size_t most_entries = 20000; // keeps a home directory from blocking the editor
    namespace fs = std::filesystem;
    std::vector<std::string> found;
    std::error_code error;
    std::size_t entries = 0;
    auto at = fs::recursive_directory_iterator(
        disk::as_path(root), fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::end(at) && entries < most_entries; at.increment(error), ++entries) {
      const auto path = at->path();
      if (path.filename().string().starts_with('.')) {
        at.disable_recursion_pending();
        continue;
      }
      std::error_code no_file;
      const bool is_source = run::language_of(path.string(), "") || testing::is_test(path.string());
      if (is_source && at->is_regular_file(no_file))
        found.push_back(path.generic_string());
    }
    std::sort(found.begin(), found.end());
    found.resize(std::min(found.size(), most_files));
    return found;
  }
};

/// Serves until the client sends `exit` or closes the stream.
ExitCode serve_editor() {
  DiskFiles disk;
  DiskFolders folders;
  editor::LanguageServer server(&disk, &folders);
  editor::MessageReader reader;
  std::array<char, 65536> bytes{};
  for (bool open = true; open || server.has_waiting();) {
    // Reads arrived messages before the next answer, so that they can cancel waiting requests.
    if (open && (!server.has_waiting() || client_speaks())) {
      const auto n = read_input(bytes);
      if (n < 0 && errno == EINTR)
        continue;
      open = n > 0;
      reader.feed({bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))});
      while (const auto event = reader.next()) {
        if (event->is_error)
          server.take_garbage(event->text);
        else
          server.take(event->text);
      }
    }
    send_all(server.answer_next());
    if (const auto well = server.ended_well())
      return *well ? ExitCode::Done : ExitCode::BadInput;
  }
  return ExitCode::BadInput; // the client closed without `exit`
}

} // namespace

void add_lsp(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("lsp", "serve editors over stdin and stdout (Language Server Protocol)",
                      "orb lsp\n"
                      "orb lsp --stdio");
  add_stdio_flag(command);
  command.callback([&context] { context.exit = serve_editor(); });
}

} // namespace orb::cli
