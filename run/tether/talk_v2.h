#pragma once

#include "base/exit_code.h"
#include "protocol/packet_v2.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <cstdint>
#include <tl/expected.hpp>

namespace orb::run {

/// A conversation with a v2 robot, one request at a time.
class TalkV2 {
public:
  TalkV2(protocol::Transport& link, const spec::RobotInfo& robot) : link_(link), robot_(robot) {}

  /// Sends a request up to three times until it is answered. Repeating is harmless for all commands
  /// but those that move the robot, and motion ends by itself. The answer may be a refusal. Fails
  /// if none came.
  tl::expected<protocol::PacketV2, Failure> ask(spec::V2Command command, Bytes data = {});

  /// As ask(), but a refusal is a failure that names the command and what helps.
  tl::expected<protocol::PacketV2, Failure> request(spec::V2Command command, Bytes data = {});

private:
  Failure silent(spec::V2Command command) const;

  protocol::Transport& link_;
  const spec::RobotInfo& robot_;
  std::uint8_t seq_ = 0;
  bool asleep_ = false; ///< it has reported sleep, and nothing since
};

} // namespace orb::run
