#pragma once

#include <string>

/// Shell commands of the runner, each in a process group of its own: a runner that is interrupted
/// ends them, and they it.
namespace shell {

/// Passes SIGINT, SIGTERM and SIGHUP on to the command that runs, from now on.
void watch_signals();
/// Whether there was such a signal; what ran then is not what the command does.
bool was_interrupted();

/// Runs a line by sh. Its wait status, as std::system has it; -1 where nothing could be started.
int run(const std::string& line);
/// Ends what commands left in the background.
void end_all();

} // namespace shell
