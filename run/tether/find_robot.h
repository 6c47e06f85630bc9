#pragma once

#include "base/exit_code.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <tl/expected.hpp>
#include <vector>

// Identifies the robot that answers when its name does not.

namespace orb::run {

/// Distinguishes v1 and v2 by their packets, and robots of v2 by their commands. The failure says
/// what helps.
tl::expected<spec::Robot, Failure> find_robot(protocol::Transport& transport, Duration patience);

/// Finds out which packets are answered: sends pings of both kinds until one is.
tl::expected<spec::Packets, Failure> find_packets(protocol::Transport& transport,
                                                  Duration patience);

/// As find_robot(), for a robot known to speak v2.
tl::expected<spec::Robot, Failure> find_newer_robot(protocol::Transport& transport);

/// Returns all v2 robots consistent with the commands of the one that answers; at least one.
tl::expected<std::vector<spec::Robot>, Failure> fitting_robots(protocol::Transport& transport);

/// Returns the only robot of a list. For longer lists the failure says how the user selects one.
tl::expected<spec::Robot, Failure> only_one(const std::vector<spec::Robot>& robots);

} // namespace orb::run
