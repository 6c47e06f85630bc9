#pragma once

#include "base/bytes.h"
#include "protocol/packet_v2.h"
#include "spec/robots.h"

#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::protocol {

/// Builds the data of a v2 request from words: numbers, 0x hex, text, hex bytes. The error names
/// the wrong operand and what it takes. Omitted trailing operands are 0.
tl::expected<Bytes, std::string> encode_operands(spec::V2Command command,
                                                 std::span<const std::string> words);

/// Makes a request with the Activity flag; `flags` may ask for an answer.
PacketV2
make_request(spec::V2Command command, Bytes data, std::uint8_t seq,
             std::uint8_t flags = static_cast<std::uint8_t>(spec::V2Flag::RequestResponse));

/// Addresses a request to a robot: sets TID and SID if the robot has two processors and the command
/// belongs to one.
PacketV2 address(PacketV2 request, const spec::RobotInfo& robot);

/// Returns true if the data has a length that the command's operands allow.
bool fits(spec::V2Command command, ByteView data);

/// Returns how a robot refuses a request whatever its state; Success if it does not. A sleeping
/// robot obeys only the device ids of serves_asleep().
spec::V2Error refusal(const PacketV2& request, const spec::RobotInfo& robot);
/// As above, for the data alone and any robot: BadLength or BadParameter.
spec::V2Error refusal(spec::V2Command command, ByteView data);

/// Returns true if a sleeping robot obeys the commands of a device id.
bool serves_asleep(std::uint8_t did);

/// Returns the size of a field in bytes; 0 if it takes all remaining bytes.
std::size_t width_of(spec::V2Type type);

void append_f32(Bytes& out, double value);
/// Reads four bytes at `offset`. The caller has checked the size.
double read_f32(ByteView bytes, std::size_t offset);

} // namespace orb::protocol
