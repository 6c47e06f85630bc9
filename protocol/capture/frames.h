#pragma once

#include "base/bytes.h"
#include "base/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace orb::protocol {

/// Types of HCI packets between a computer and its Bluetooth controller (H4).
enum class HciType : std::uint8_t { Command = 1, Acl = 2, Sco = 3, Event = 4, Iso = 5 };

/// Direction as seen by the computer.
enum class Way : std::uint8_t { Sent, Received };

struct HciPacket {
  std::size_t frame = 0; ///< number in the file, from 1
  Duration at{};         ///< since an arbitrary moment, the same for a whole file
  HciType type = HciType::Acl;
  std::optional<Way> way;    ///< nullopt if the file does not tell
  std::uint32_t adapter = 0; ///< index of the adapter
  ByteView bytes;
};

/// The content of a capture file. The packets are views into the file.
struct Frames {
  std::string_view format; ///< `btsnoop`, `pcap` or `pcapng`
  std::size_t count = 0;   ///< all frames, whatever their content
  Duration start{};        ///< time of the first frame, on the packets' time scale
  std::vector<HciPacket> packets;
  bool cut = false;                          ///< the file ends inside a frame
  std::optional<std::uint32_t> foreign_link; ///< a link type that is not Bluetooth HCI
};

/// Reads a file of the formats in `protocol/capture/btsnoop.cpp` and `pcap.cpp`, recognised by its
/// first bytes; nullopt for others. Accepts any bytes.
std::optional<Frames> read_frames(ByteView file);

// The formats. Each function requires a file that begins accordingly.
bool is_btsnoop(ByteView file);
Frames read_btsnoop(ByteView file);
bool is_pcap(ByteView file);
Frames read_pcap(ByteView file);
bool is_pcapng(ByteView file);
Frames read_pcapng(ByteView file);

/// How a frame states its type.
enum class Framing : std::uint8_t {
  H4,        ///< the type comes first
  H4WithWay, ///< four bytes of direction, then the type
  Monitor    ///< Linux monitor: adapter and an opcode
};

/// Parses a frame with that framing; nullopt if it is not an HCI packet.
std::optional<HciPacket> hci_packet(Framing framing, ByteView frame);
/// Parses a packet with an opcode of the Linux monitor; nullopt if it is not an HCI packet.
std::optional<HciPacket> monitor_packet(std::uint32_t opcode, std::uint32_t adapter,
                                        ByteView bytes);

/// Read little-endian numbers. The caller has checked the size.
constexpr std::uint16_t read_le16(ByteView bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}
constexpr std::uint32_t read_le32(ByteView bytes, std::size_t at) {
  return read_le16(bytes, at) | static_cast<std::uint32_t>(read_le16(bytes, at + 2)) << 16;
}

} // namespace orb::protocol
