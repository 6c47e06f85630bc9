#pragma once

#include "protocol/packet_v2.h"
#include "spec/robots.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orb::protocol {

/// Says what v2 packets mean. It hears both directions: what a sample holds depends on what was
/// asked for before.
class DescriberV2 {
public:
  /// One line, every field named.
  std::string describe(const ItemV2& item);
  /// What the data of a packet means: `speed 60, heading 90, flags 0`; empty where neither the
  /// tables nor what was asked before say it.
  std::string fields_of(const PacketV2& packet) const;

private:
  /// The services that an RVR streams under a token of a processor, and how wide each value is.
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

/// The name of the command or message; empty where no row has it.
std::string_view name_of(const PacketV2& packet);

} // namespace orb::protocol
