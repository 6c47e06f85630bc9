#pragma once

#include "protocol/capture/frames.h"

#include <map>
#include <string>
#include <vector>

namespace orb::protocol {

/// A packet of L2CAP, reassembled from its fragments.
struct L2capPacket {
  std::size_t frame = 0; ///< the frame that completed it
  Duration at{};
  std::optional<Way> way;
  std::uint16_t channel = 0;
  Bytes bytes;
};

/// The traffic between a computer and another device, from connection to disconnection.
struct Connection {
  std::string address; ///< of the other device; empty if the capture began later
  bool has_start = false;
  bool has_end = false;
  std::vector<L2capPacket> packets;
};

struct Connections {
  std::vector<Connection> all;
  std::map<std::string, std::string> names; ///< the devices' own names, by address
};

/// Follows HCI events and collects the packets of each connection.
Connections read_connections(const std::vector<HciPacket>& packets);

/// Channel of the Attribute Protocol.
inline constexpr std::uint16_t att_channel = 4;
/// Lowest dynamically allocated channel; RFCOMM uses one of them.
inline constexpr std::uint16_t first_agreed_channel = 0x40;

} // namespace orb::protocol
