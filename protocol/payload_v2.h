#pragma once

#include "base/bytes.h"
#include "protocol/packet_v2.h"
#include "spec/robots.h"

#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::protocol {

/// What a request of packets v2 carries, from words: numbers, 0x hex, text, hex bytes. The error
/// says which operand is wrong and what it takes. Operands that are left out at the end are 0.
tl::expected<Bytes, std::string> encode_operands(spec::V2Command command,
                                                 std::span<const std::string> words);

/// A request: with Activity, and an answer wanted where `flags` says so.
PacketV2
make_request(spec::V2Command command, Bytes data, std::uint8_t seq,
             std::uint8_t flags = static_cast<std::uint8_t>(spec::V2Flag::RequestResponse));

/// The same for a robot: with TID and SID where it has two processors and the command is for one.
PacketV2 address(PacketV2 request, const spec::RobotInfo& robot);

/// Whether the data of a request has a length that its operands can have.
bool fits(spec::V2Command command, ByteView data);

/// How many bytes a field has; 0 for one that takes all that are left.
std::size_t width_of(spec::V2Type type);

void append_f32(Bytes& out, double value);
/// Four bytes at `offset`; the caller has checked the size.
double read_f32(ByteView bytes, std::size_t offset);

} // namespace orb::protocol
