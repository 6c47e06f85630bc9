#pragma once

#include "cli/model/command.h"
#include "cli/robot/link.h"

#include <string>

namespace orb::cli {

/// Adds `--sleep`.
void add_sleep_option(const Command& command, bool& sleeps);

/// What became of it, in a sentence for the end of a command.
struct Slept {
  ExitCode exit = ExitCode::Done;
  std::string words;
};

/// Puts the robot to sleep, until it is woken: whether it has acknowledged that.
Slept put_to_sleep(protocol::Transport& transport, spec::Robot robot, const Link& link);

/// That nothing was sent, because the link had been lost before.
Slept left_awake();

} // namespace orb::cli
