#pragma once

#include "base/exit_code.h"
#include "protocol/packet_v2.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <cstdint>
#include <tl/expected.hpp>

namespace orb::run {

/// A conversation with a robot of packets v2, one request at a time.
class TalkV2 {
public:
  TalkV2(protocol::Transport& link, const spec::RobotInfo& robot) : link_(link), robot_(robot) {}

  /// Sends until it is answered, three times at most: every command but those that move it does no
  /// harm twice, and those that move it end by themselves. The answer may be a refusal. Fails where
  /// none came.
  tl::expected<protocol::PacketV2, Failure> ask(spec::V2Command command, Bytes data = {});

  /// The same, and a refusal is a failure that names it and what helps.
  tl::expected<protocol::PacketV2, Failure> request(spec::V2Command command, Bytes data = {});

private:
  Failure silent(spec::V2Command command) const;

  protocol::Transport& link_;
  const spec::RobotInfo& robot_;
  std::uint8_t seq_ = 0;
  bool asleep_ = false; ///< it has said so, and nothing since
};

} // namespace orb::run
