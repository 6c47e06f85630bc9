// Android's btsnoop_hci.log, and the output of BlueZ's `btmon -w`. Source: RFC 1761 (snoop), and
// the data link types of Frontline and BlueZ.

#include "protocol/capture/frames.h"

namespace orb::protocol {
namespace {

constexpr std::string_view magic{"btsnoop\0", 8};
constexpr std::size_t file_head = 16;   // magic, version, data link
constexpr std::size_t record_head = 24; // sizes, flags, drops, time

constexpr std::uint32_t link_h1 = 1001;      // without packet type
constexpr std::uint32_t link_h4 = 1002;      // with packet type
constexpr std::uint32_t link_monitor = 2001; // Linux monitor

// Flags of a record.
constexpr std::uint32_t received = 1;
constexpr std::uint32_t command_or_event = 2;

/// Derives the packet type from the flags.
HciPacket untyped(std::uint32_t flags, ByteView bytes) {
  HciPacket packet;
  const bool in = (flags & received) != 0;
  packet.type = (flags & command_or_event) == 0 ? HciType::Acl
                : in                            ? HciType::Event
                                                : HciType::Command;
  packet.bytes = bytes;
  return packet;
}

std::optional<HciPacket> packet_of(std::uint32_t link, std::uint32_t flags, ByteView bytes) {
  if (link == link_monitor) {
    constexpr std::uint32_t adapter_at = 16; // bits
    return monitor_packet(flags & UINT16_MAX, flags >> adapter_at, bytes);
  }
  auto packet = link == link_h1 ? untyped(flags, bytes) : hci_packet(Framing::H4, bytes);
  if (packet)
    packet->way = (flags & received) != 0 ? Way::Received : Way::Sent;
  return packet;
}

/// Time stamps count from the year 0, which exceeds the range of nanoseconds; counting from the
/// first frame does not.
Duration since(std::uint64_t first, std::uint64_t micros) {
  constexpr std::int64_t century = 3'155'760'000'000'000; // larger values are not valid times
  const auto passed = static_cast<std::int64_t>(micros - first);
  return std::chrono::microseconds{passed < -century || passed > century ? 0 : passed};
}

} // namespace

bool is_btsnoop(ByteView file) {
  return as_text(file).starts_with(magic);
}

Frames read_btsnoop(ByteView file) {
  Frames frames;
  frames.format = "btsnoop";
  if (file.size() < file_head) {
    frames.cut = true;
    return frames;
  }
  const auto link = read_u32(file, magic.size() + sizeof(std::uint32_t));
  if (link != link_h1 && link != link_h4 && link != link_monitor)
    frames.foreign_link = link;
  std::optional<std::uint64_t> first;
  for (file = file.subspan(file_head); !file.empty();) {
    const auto size = file.size() < record_head ? 0 : read_u32(file, 4);
    if (file.size() < record_head || size > file.size() - record_head) {
      frames.cut = true;
      break;
    }
    const auto flags = read_u32(file, 8);
    const auto micros = std::uint64_t{read_u32(file, 16)} << 32 | read_u32(file, 20);
    ++frames.count;
    first = first.value_or(micros);
    if (!frames.foreign_link)
      if (auto packet = packet_of(link, flags, file.subspan(record_head, size))) {
        packet->frame = frames.count;
        packet->at = since(*first, micros);
        frames.packets.push_back(*packet);
      }
    file = file.subspan(record_head + size);
  }
  return frames;
}

} // namespace orb::protocol
