#pragma once

#include "base/bytes.h"
#include "spec/packet_v2.h"

#include <optional>

namespace orb::protocol {

/// A packet of the newer robots: a command, or with the Response flag an answer. Source: PKT.
struct PacketV2 {
  std::uint8_t flags = 0;  ///< spec::V2Flag bits
  Bytes extended_flags{};  ///< while the byte before has V2Flag::Extended
  std::uint8_t target = 0; ///< where flags say so: port and node in a nibble each
  std::uint8_t source = 0; ///< where flags say so
  std::uint8_t did = 0;
  std::uint8_t cid = 0;
  std::uint8_t seq = 0;
  std::uint8_t error = 0; ///< of a response
  Bytes data{};

  friend bool operator==(const PacketV2&, const PacketV2&) = default;
};

/// The bytes on the wire, escaped.
Bytes encode(const PacketV2& packet);

/// One thing found in a stream of v2 bytes.
struct ItemV2 {
  enum class Kind : std::uint8_t {
    Packet,
    Noise, ///< bytes that begin no packet, or a packet that makes no sense
    BadChecksum,
    Incomplete ///< a packet whose end never came (see DecoderV2::expire)
  };
  Kind kind = Kind::Noise;
  PacketV2 packet; ///< of a Packet
  std::uint8_t checksum = 0;
  std::uint8_t right_checksum = 0; ///< of a BadChecksum
  Bytes raw;
};

/// Finds v2 packets in a stream that arrives in pieces of any size; keeps at most one incomplete
/// packet and never fails.
class DecoderV2 {
public:
  void feed(ByteView bytes);
  std::optional<ItemV2> next();
  /// Whether it holds bytes that are no whole packet yet.
  bool pending() const { return at_ < kept_.size(); }
  /// Gives up waiting for the end of an incomplete packet.
  void expire() { expired_ = true; }

private:
  ItemV2 take(std::size_t size, ItemV2::Kind kind);

  Bytes kept_;
  std::size_t at_ = 0;
  bool expired_ = false;
};

} // namespace orb::protocol
