#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

// Shared by `orb lsp` and `orb dap`: the editor is at the other end of stdin and stdout.

namespace orb::cli {

class Command;

/// Sends messages, each in its own frame.
void send_all(const std::vector<std::string>& messages);

/// True if a message has arrived or the client is gone: reading does not block.
bool client_speaks();

/// Adds `--stdio`, which has no effect.
void add_stdio_flag(const Command& command);

} // namespace orb::cli
