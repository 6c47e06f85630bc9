#pragma once

#include "protocol/packet_v2.h"
#include "spec/robots.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orb::protocol {

/// Describes v2 packets. Needs both directions, because the content of a sample depends on earlier
/// requests.
class DescriberV2 {
public:
  /// Returns one line with every field named.
  std::string describe(const ItemV2& item);
  /// Describes the data of a packet: `speed 60, heading 90, flags 0`; empty if neither the tables
  /// nor earlier requests tell.
  std::string fields_of(const PacketV2& packet) const;

private:
  /// A service that an RVR's processor streams under a token, with the width of its values.
  struct Service {
    const spec::V2ServiceInfo* row;
    int bits;
  };
  using Token = std::pair<std::uint8_t, std::uint8_t>; ///< processor, token

  void note(const PacketV2& packet);
  std::string sample(ByteView data) const;
  std::string service_sample(const PacketV2& packet) const;

  std::uint32_t mask_ = 0;
  std::uint32_t extended_ = 0;
  std::map<Token, std::vector<Service>> services_;
};

/// `command`, `response`, or `message`: what a robot says unasked.
std::string_view kind_of(const PacketV2& packet);

/// Returns the name of the command or message; empty if no row has it.
std::string_view name_of(const PacketV2& packet);

} // namespace orb::protocol
