#pragma once

#include "base/bytes.h"
#include "spec/packet_v2.h"

#include <optional>

namespace orb::protocol {

/// A packet of the newer robots: a command, or an answer if it has the Response flag. Source: PKT.
struct PacketV2 {
  std::uint8_t flags = 0;  ///< spec::V2Flag bits
  Bytes extended_flags{};  ///< present while the byte before has V2Flag::Extended
  std::uint8_t target = 0; ///< if the flags say so: port and node, a nibble each
  std::uint8_t source = 0; ///< if the flags say so
  std::uint8_t did = 0;
  std::uint8_t cid = 0;
  std::uint8_t seq = 0;
  std::uint8_t error = 0; ///< for responses
  Bytes data{};

  friend bool operator==(const PacketV2&, const PacketV2&) = default;
};

/// Returns the bytes on the wire, escaped.
Bytes encode(const PacketV2& packet);

/// An item found in a stream of v2 bytes.
struct ItemV2 {
  enum class Kind : std::uint8_t {
    Packet,
    Noise, ///< bytes outside any packet, or an invalid packet
    BadChecksum,
    Incomplete ///< a packet without its end (see DecoderV2::expire)
  };
  Kind kind = Kind::Noise;
  PacketV2 packet; ///< for Packet
  std::uint8_t checksum = 0;
  std::uint8_t right_checksum = 0; ///< for BadChecksum
  Bytes raw;
};

/// Returns how many bytes belong to whole v2 packets.
std::size_t understood_as_v2(ByteView bytes);

/// Finds v2 packets in a stream that arrives in pieces of any size. Keeps at most one incomplete
/// packet and never fails.
class DecoderV2 {
public:
  void feed(ByteView bytes);
  std::optional<ItemV2> next();
  /// Returns true if it holds an incomplete packet.
  bool pending() const { return at_ < kept_.size(); }
  /// Stops waiting for the end of an incomplete packet.
  void expire() { expired_ = true; }

private:
  ItemV2 take(std::size_t size, ItemV2::Kind kind);

  Bytes kept_;
  std::size_t at_ = 0;
  bool expired_ = false;
};

} // namespace orb::protocol
