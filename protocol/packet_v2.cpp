#include "protocol/packet_v2.h"

#include "protocol/packet.h"

#include <algorithm>

namespace orb::protocol {
namespace {

constexpr bool is_special(std::uint8_t byte) {
  return byte == spec::v2_start || byte == spec::v2_end || byte == spec::v2_escape;
}

/// Removes escapes from header, data and checksum; nullopt for an invalid escape.
std::optional<Bytes> unescape(ByteView bytes) {
  Bytes out;
  out.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != spec::v2_escape) {
      out.push_back(bytes[i]);
      continue;
    }
    if (++i == bytes.size())
      return std::nullopt;
    const auto byte = static_cast<std::uint8_t>(bytes[i] | spec::v2_escape_bits);
    if ((bytes[i] & spec::v2_escape_bits) != 0 || !is_special(byte))
      return std::nullopt;
    out.push_back(byte);
  }
  return out;
}

/// Parses the header. Returns false if the packet is too short.
bool read_packet(ByteView bytes, PacketV2& packet) {
  std::size_t at = 0;
  const auto take = [&](std::uint8_t& field) {
    if (at == bytes.size())
      return false;
    field = bytes[at++];
    return true;
  };
  if (!take(packet.flags))
    return false;
  for (auto flags = packet.flags; spec::has(flags, spec::V2Flag::Extended);) {
    if (!take(flags))
      return false;
    packet.extended_flags.push_back(flags);
  }
  if (spec::has(packet.flags, spec::V2Flag::HasTarget) && !take(packet.target))
    return false;
  if (spec::has(packet.flags, spec::V2Flag::HasSource) && !take(packet.source))
    return false;
  if (!take(packet.did) || !take(packet.cid) || !take(packet.seq))
    return false;
  if (spec::has(packet.flags, spec::V2Flag::Response) && !take(packet.error))
    return false;
  packet.data.assign(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end());
  return true;
}

} // namespace

Bytes encode(const PacketV2& packet) {
  Bytes plain{packet.flags};
  plain.insert(plain.end(), packet.extended_flags.begin(), packet.extended_flags.end());
  if (spec::has(packet.flags, spec::V2Flag::HasTarget))
    plain.push_back(packet.target);
  if (spec::has(packet.flags, spec::V2Flag::HasSource))
    plain.push_back(packet.source);
  plain.insert(plain.end(), {packet.did, packet.cid, packet.seq});
  if (spec::has(packet.flags, spec::V2Flag::Response))
    plain.push_back(packet.error);
  plain.insert(plain.end(), packet.data.begin(), packet.data.end());
  plain.push_back(checksum(plain));

  Bytes out{spec::v2_start};
  for (const auto byte : plain) {
    if (is_special(byte)) {
      out.push_back(spec::v2_escape);
      out.push_back(static_cast<std::uint8_t>(byte & ~spec::v2_escape_bits));
    } else {
      out.push_back(byte);
    }
  }
  out.push_back(spec::v2_end);
  return out;
}

void DecoderV2::feed(ByteView bytes) {
  kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ = 0;
  kept_.insert(kept_.end(), bytes.begin(), bytes.end());
}

ItemV2 DecoderV2::take(std::size_t size, ItemV2::Kind kind) {
  ItemV2 item;
  item.kind = kind;
  const auto from = kept_.begin() + static_cast<std::ptrdiff_t>(at_);
  item.raw.assign(from, from + static_cast<std::ptrdiff_t>(size));
  at_ += size;
  return item;
}

std::optional<ItemV2> DecoderV2::next() {
  const auto bytes = ByteView(kept_).subspan(at_);
  if (bytes.empty()) {
    expired_ = false;
    return std::nullopt;
  }
  const auto start = static_cast<std::size_t>(
      std::find(bytes.begin(), bytes.end(), spec::v2_start) - bytes.begin());
  if (start > 0)
    return take(start, ItemV2::Kind::Noise);
  const auto is_border = [](std::uint8_t byte) {
    return byte == spec::v2_start || byte == spec::v2_end;
  };
  const auto end = static_cast<std::size_t>(
      std::find_if(bytes.begin() + 1, bytes.end(), is_border) - bytes.begin());
  if (end == bytes.size() && end <= spec::v2_max_packet && !expired_)
    return std::nullopt;
  if (end == bytes.size())
    return take(end, expired_ ? ItemV2::Kind::Incomplete : ItemV2::Kind::Noise);
  if (bytes[end] == spec::v2_start)
    return take(end, ItemV2::Kind::Noise); // its end was lost

  auto plain = unescape(bytes.subspan(1, end - 1));
  auto item = take(end + 1, ItemV2::Kind::Noise);
  if (!plain || plain->empty())
    return item;
  item.checksum = plain->back();
  plain->pop_back();
  item.right_checksum = checksum(*plain);
  if (!read_packet(*plain, item.packet))
    return item;
  item.kind =
      item.checksum == item.right_checksum ? ItemV2::Kind::Packet : ItemV2::Kind::BadChecksum;
  return item;
}

std::size_t understood_as_v2(ByteView bytes) {
  DecoderV2 decoder;
  decoder.feed(bytes);
  std::size_t count = 0;
  while (const auto item = decoder.next())
    if (item->kind == ItemV2::Kind::Packet)
      count += item->raw.size();
  return count;
}

} // namespace orb::protocol
