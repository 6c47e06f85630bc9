#pragma once

#include "protocol/decoder.h"
#include "protocol/packet_v2.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <optional>
#include <tl/expected.hpp>

namespace orb::run {

/// A link whose packet version is still unknown. Passes v1 requests through unchanged; if nothing
/// answers for a while, adds a v2 ping.
class Hail final : public protocol::Transport {
public:
  /// `link` must outlive it.
  explicit Hail(protocol::Transport& link) : link_(link) {}

  Instant now() const override { return link_.now(); }
  /// Once a v2 robot has answered, writing and reading fail with Unfit.
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

  /// The packet version of the first answer; nullopt if there was none.
  const std::optional<spec::Packets>& answered() const { return answered_; }
  /// Returns true if the link only returned what was sent.
  bool echoes() const { return echoes_ && !answered_; }

private:
  tl::expected<void, protocol::LinkError> ping();
  void hear(ByteView bytes);

  protocol::Transport& link_;
  protocol::Decoder v1_{protocol::Direction::FromBall};
  protocol::DecoderV2 v2_;
  std::optional<spec::Packets> answered_;
  Instant ping_at_ = never; ///< next v2 ping, if nothing answers first
  bool echoes_ = false;
};

} // namespace orb::run
