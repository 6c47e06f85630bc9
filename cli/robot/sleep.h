#pragma once

#include "cli/model/command.h"
#include "cli/robot/link.h"

#include <string>

namespace orb::cli {

/// Adds `--sleep`.
void add_sleep_option(const Command& command, bool& sleeps);

/// The result, as a sentence for the end of a command.
struct Slept {
  ExitCode exit = ExitCode::Done;
  std::string words;
};

/// Puts the robot to sleep until something wakes it; tells if it acknowledged.
Slept put_to_sleep(protocol::Transport& transport, spec::Robot robot, const Link& link);

/// The result if the link was lost before: nothing was sent.
Slept left_awake();

} // namespace orb::cli
