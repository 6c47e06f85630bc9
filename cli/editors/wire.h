#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

// What `orb lsp` and `orb dap` share: editors at the other end of stdin and stdout.

namespace orb::cli {

class Command;

/// Sends messages, each in its frame.
void send_all(const std::vector<std::string>& messages);

/// Whether the client has said something, or is gone: reading does not wait.
bool client_speaks();

/// Adds `--stdio`, which changes nothing.
void add_stdio_flag(const Command& command);

} // namespace orb::cli
