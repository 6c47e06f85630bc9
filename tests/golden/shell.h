#pragma once

#include <string>

/// Shell commands of the runner, each in its own process group, so that an interrupted runner can
/// end them.
namespace shell {

/// From now on, passes SIGINT, SIGTERM and SIGHUP to the running command.
void watch_signals();
/// True if there was such a signal: the output is then incomplete.
bool was_interrupted();

/// Runs a line by sh. Returns its wait status, as std::system does; -1 if it could not be started.
int run(const std::string& line);
/// Ends background processes that commands left behind.
void end_all();

} // namespace shell
