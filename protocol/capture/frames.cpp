#include "protocol/capture/frames.h"

namespace orb::protocol {

std::optional<Frames> read_frames(ByteView file) {
  if (is_btsnoop(file))
    return read_btsnoop(file);
  if (is_pcapng(file))
    return read_pcapng(file);
  if (is_pcap(file))
    return read_pcap(file);
  return std::nullopt;
}

std::optional<HciPacket> monitor_packet(std::uint32_t opcode, std::uint32_t adapter,
                                        ByteView bytes) {
  HciPacket packet;
  packet.adapter = adapter;
  packet.bytes = bytes;
  switch (opcode) {
  case 2: packet.type = HciType::Command, packet.way = Way::Sent; break;
  case 3: packet.type = HciType::Event, packet.way = Way::Received; break;
  case 4: packet.type = HciType::Acl, packet.way = Way::Sent; break;
  case 5: packet.type = HciType::Acl, packet.way = Way::Received; break;
  default: return std::nullopt; // notes, voice, adapters that come and go
  }
  return packet;
}

std::optional<HciPacket> hci_packet(Framing framing, ByteView frame) {
  constexpr std::size_t head = 4; // direction, or adapter and opcode
  if (framing != Framing::H4 && frame.size() < head)
    return std::nullopt;
  if (framing == Framing::Monitor)
    return monitor_packet(read_u16(frame, 2), read_u16(frame, 0), frame.subspan(head));
  HciPacket packet;
  if (framing == Framing::H4WithWay) {
    packet.way = read_u32(frame, 0) == 0 ? Way::Sent : Way::Received;
    frame = frame.subspan(head);
  }
  if (frame.empty() || frame[0] < static_cast<std::uint8_t>(HciType::Command) ||
      frame[0] > static_cast<std::uint8_t>(HciType::Iso))
    return std::nullopt;
  packet.type = static_cast<HciType>(frame[0]);
  packet.bytes = frame.subspan(1);
  return packet;
}

} // namespace orb::protocol
