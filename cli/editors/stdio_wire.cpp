#include "cli/editors/stdio_wire.h"

#include "cli/context/console.h"
#include "cli/context/context.h"
#include "cli/model/command.h"
#include "editor/wire.h"

namespace orb::cli {

void send_all(const std::vector<std::string>& messages) {
  for (const auto& message : messages)
    print_out(editor::frame(message));
}

bool client_speaks() {
  return input_waits();
}

void add_stdio_flag(const Command& command) {
  command.add_flag("--stdio", "for editors that insist on it; has no effect");
}

} // namespace orb::cli
