#pragma once

#include "base/exit_code.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <tl/expected.hpp>
#include <vector>

// Which robot answers, where its name does not tell.

namespace orb::run {

/// Of packets v1 or v2 and, of those, which by the commands that it knows. The failure says what
/// helps.
tl::expected<spec::Robot, Failure> find_robot(protocol::Transport& transport, Duration patience);

/// Which packets are answered: pings of both kinds are sent until one is.
tl::expected<spec::Packets, Failure> find_packets(protocol::Transport& transport,
                                                  Duration patience);

/// The same as find_robot() where it is known that packets v2 are spoken.
tl::expected<spec::Robot, Failure> find_newer_robot(protocol::Transport& transport);

/// All robots of packets v2 that the one that answers can be, by the commands that it knows; one at
/// least.
tl::expected<std::vector<spec::Robot>, Failure> fitting_robots(protocol::Transport& transport);

/// The one robot of a list; the failure of a longer one says how the user tells which.
tl::expected<spec::Robot, Failure> only_one(const std::vector<spec::Robot>& robots);

} // namespace orb::run
