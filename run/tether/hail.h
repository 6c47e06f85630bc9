#pragma once

#include "protocol/decoder.h"
#include "protocol/packet_v2.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <optional>
#include <tl/expected.hpp>

namespace orb::run {

/// A link of which nobody knows yet which packets are spoken there. What is asked in packets v1
/// goes out as it is; only where nothing has answered it for a while, a ping of packets v2 follows.
class Hail final : public protocol::Transport {
public:
  /// `link` must outlive it.
  explicit Hail(protocol::Transport& link) : link_(link) {}

  Instant now() const override { return link_.now(); }
  /// Once a robot of packets v2 has answered, writing and reading are errors: Unfit.
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

  /// What was answered first; nothing as long as nothing was.
  const std::optional<spec::Packets>& answered() const { return answered_; }
  /// What was sent came back as it was, and nothing else did.
  bool echoes() const { return echoes_ && !answered_; }

private:
  tl::expected<void, protocol::LinkError> ping();
  void hear(ByteView bytes);

  protocol::Transport& link_;
  protocol::Decoder v1_{protocol::Direction::FromBall};
  protocol::DecoderV2 v2_;
  std::optional<spec::Packets> answered_;
  Instant ping_at_ = never; ///< of packets v2, unless something answers before
  bool echoes_ = false;
};

} // namespace orb::run
