#include "protocol/packet.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace orb::protocol {
namespace {

void append(Bytes& out, ByteView bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

template <class Packet>
Bytes encoded(const Packet& packet) {
  Bytes out;
  encode(packet, out);
  return out;
}

/// Appends the checksum of everything after the two start bytes at `start`.
void close_packet(Bytes& out, std::size_t start) {
  out.push_back(checksum(ByteView(out).subspan(start + spec::sop_size)));
}

} // namespace

Command make_command(spec::ApiCommand command, Bytes data, std::uint8_t seq) {
  return {
      .did = spec::did(command), .cid = spec::cid(command), .seq = seq, .data = std::move(data)};
}

std::uint8_t checksum(ByteView bytes) {
  // Adds eight bytes at a time, even and odd ones separately into four 16-bit lanes each, which
  // cannot overflow within one block.
  constexpr std::uint64_t lanes = 0x00FF00FF00FF00FF;        // the low byte of each
  constexpr std::size_t block = 128 * sizeof(std::uint64_t); // 2 x 128 x 255 fits into 16 bits
  const auto* at = bytes.data();
  auto left = bytes.size();
  std::uint64_t sum = 0;
  while (left >= sizeof(std::uint64_t)) {
    const auto end = at + std::min(left, block) / sizeof(std::uint64_t) * sizeof(std::uint64_t);
    std::uint64_t lane_sums = 0;
    left -= static_cast<std::size_t>(end - at);
    for (; at != end; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, at, sizeof word);
      lane_sums += (word & lanes) + (word >> 8 & lanes);
    }
    for (; lane_sums != 0; lane_sums >>= 16)
      sum += static_cast<std::uint16_t>(lane_sums);
  }
  for (; left > 0; --left)
    sum += *at++;
  return static_cast<std::uint8_t>(~sum);
}

bool fits(std::uint8_t did, std::uint8_t cid, std::size_t payload_size) {
  const auto fixed = spec::long_payload(did, cid);
  return fixed == 0 ? payload_size <= spec::max_payload
                    : payload_size == fixed || payload_size < spec::max_payload;
}

void encode(const Command& command, Bytes& out) {
  const auto fixed = spec::long_payload(command.did, command.cid);
  const auto is_long = fixed != 0 && command.data.size() >= fixed;
  const auto size = std::min(command.data.size(), is_long ? fixed : spec::max_payload);
  const auto start = out.size();
  out.insert(out.end(), {spec::sop1, command.flags, command.did, command.cid, command.seq,
                         is_long ? spec::dlen_long : static_cast<std::uint8_t>(size + 1)});
  append(out, ByteView(command.data).first(size));
  close_packet(out, start);
}

void encode(const Response& response, Bytes& out) {
  const auto size = std::min(response.data.size(), spec::max_payload);
  const auto start = out.size();
  out.insert(out.end(), {spec::sop1, spec::sop2_response, response.code, response.seq,
                         static_cast<std::uint8_t>(size + 1)});
  append(out, ByteView(response.data).first(size));
  close_packet(out, start);
}

void encode(const Async& async, Bytes& out) {
  const auto size = std::min(async.data.size(), spec::max_async_payload);
  const auto start = out.size();
  out.insert(out.end(), {spec::sop1, spec::sop2_async, async.id});
  append_u16(out, static_cast<std::uint32_t>(size + 1));
  append(out, ByteView(async.data).first(size));
  close_packet(out, start);
}

Bytes encode(const Command& command) {
  return encoded(command);
}
Bytes encode(const Response& response) {
  return encoded(response);
}
Bytes encode(const Async& async) {
  return encoded(async);
}

} // namespace orb::protocol
