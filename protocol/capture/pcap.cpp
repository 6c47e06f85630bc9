// The formats of Wireshark, tshark and tcpdump: pcap and pcapng. Source: the drafts
// draft-ietf-opsawg-pcap and draft-ietf-opsawg-pcapng, and the registry of link types.

#include "protocol/capture/frames.h"

namespace orb::protocol {
namespace {

std::optional<Framing> framing_of(std::uint32_t link) {
  switch (link) {
  case 187: return Framing::H4;        // LINKTYPE_BLUETOOTH_HCI_H4
  case 201: return Framing::H4WithWay; // LINKTYPE_BLUETOOTH_HCI_H4_WITH_PHDR
  case 254: return Framing::Monitor;   // LINKTYPE_BLUETOOTH_LINUX_MONITOR
  default: return std::nullopt;
  }
}

/// A file has the byte order of the machine that wrote it.
enum class ByteOrder : std::uint8_t { Little, Big };
std::uint16_t read16(ByteOrder order, ByteView bytes, std::size_t at) {
  return order == ByteOrder::Little ? read_le16(bytes, at) : read_u16(bytes, at);
}
std::uint32_t read32(ByteOrder order, ByteView bytes, std::size_t at) {
  return order == ByteOrder::Little ? read_le32(bytes, at) : read_u32(bytes, at);
}

/// Adds a frame with its link type and time.
void add_frame(Frames& frames, std::uint32_t link, std::uint32_t interface, Duration at,
               ByteView frame) {
  if (frames.count++ == 0)
    frames.start = at;
  const auto framing = framing_of(link);
  if (!framing) {
    frames.foreign_link = link;
    return;
  }
  auto packet = hci_packet(*framing, frame);
  if (!packet)
    return;
  packet->frame = frames.count;
  packet->at = at;
  packet->adapter += interface << 16; // adapter numbers of an interface have 16 bits
  frames.packets.push_back(*packet);
}

// pcap

constexpr std::uint32_t pcap_micros = 0xA1B2C3D4; // fraction in microseconds
constexpr std::uint32_t pcap_nanos = 0xA1B23C4D;  // fraction in nanoseconds
constexpr std::size_t pcap_head = 24;
constexpr std::size_t pcap_record = 16;

std::optional<ByteOrder> pcap_order(ByteView file) {
  if (file.size() < sizeof(std::uint32_t))
    return std::nullopt;
  for (const auto order : {ByteOrder::Little, ByteOrder::Big}) {
    const auto magic = read32(order, file, 0);
    if (magic == pcap_micros || magic == pcap_nanos)
      return order;
  }
  return std::nullopt;
}

// pcapng

constexpr std::uint32_t section_block = 0x0A0D0D0A; // the same in both byte orders
constexpr std::uint32_t section_order = 0x1A2B3C4D; // reveals the byte order
constexpr std::uint32_t interface_block = 1;
constexpr std::uint32_t old_packet_block = 2;
constexpr std::uint32_t simple_packet_block = 3;
constexpr std::uint32_t packet_block = 6;
constexpr std::size_t block_ends = 12; // type, size, and the size repeated
constexpr std::size_t block_head = 8;

struct Interface {
  std::uint32_t link = 0;
  std::uint32_t snap_length = 0;
  double tick_ns = 1000; ///< the default: microseconds
};

/// Length of a time-stamp tick: option if_tsresol.
double tick_of(ByteOrder order, ByteView options) {
  constexpr std::uint16_t resolution = 9;
  constexpr std::size_t head = 4;
  while (options.size() >= head) {
    const std::size_t size = read16(order, options, 2);
    if (read16(order, options, 0) == resolution && size >= 1 && options.size() > head) {
      const unsigned exponent = options[head] & 0x7FU;
      double tick = 1e9;
      for (unsigned i = 0; i < exponent; ++i)
        tick /= (options[head] & 0x80U) != 0 ? 2 : 10;
      return tick;
    }
    const auto padded = head + (size + 3) / 4 * 4;
    if (padded > options.size())
      break;
    options = options.subspan(padded);
  }
  return Interface{}.tick_ns;
}

class Section {
public:
  Section(ByteOrder order, Frames& frames) : order_(order), frames_(frames) {}

  void take(std::uint32_t type, ByteView body) {
    switch (type) {
    case interface_block: return take_interface(body);
    case packet_block: return take_packet(body, word(body, 0));
    case old_packet_block: return take_packet(body, body.size() < 2 ? 0 : read16(order_, body, 0));
    case simple_packet_block: return take_simple(body);
    default: break; // names, statistics, secrets
    }
  }

private:
  std::uint32_t word(ByteView body, std::size_t index) const {
    const auto at = index * sizeof(std::uint32_t);
    return body.size() < at + sizeof(std::uint32_t) ? 0 : read32(order_, body, at);
  }

  void take_interface(ByteView body) {
    constexpr std::size_t options = 8;
    if (body.size() < options)
      return;
    interfaces_.push_back(
        {read16(order_, body, 0), word(body, 1), tick_of(order_, body.subspan(options))});
  }

  void take_packet(ByteView body, std::uint32_t interface) {
    constexpr std::size_t head = 20; // interface, time, sizes
    const auto size = word(body, 3);
    if (body.size() < head || size > body.size() - head || interface >= interfaces_.size())
      return;
    const auto ticks = std::uint64_t{word(body, 1)} << 32 | word(body, 2);
    const double ns = static_cast<double>(ticks) * interfaces_[interface].tick_ns;
    constexpr double too_long = 9e18; // limit of a Duration in nanoseconds
    add_frame(frames_, interfaces_[interface].link, interface,
              Duration{ns < too_long ? static_cast<Duration::rep>(ns) : 0},
              body.subspan(head, size));
  }

  /// Simple packets belong to the first interface and have no time.
  void take_simple(ByteView body) {
    constexpr std::size_t head = 4;
    if (body.size() < head || interfaces_.empty())
      return;
    auto frame = body.subspan(head);
    if (word(body, 0) < frame.size())
      frame = frame.first(word(body, 0)); // the rest is padding
    add_frame(frames_, interfaces_[0].link, 0, Duration{}, frame);
  }

  ByteOrder order_;
  Frames& frames_;
  std::vector<Interface> interfaces_;
};

} // namespace

bool is_pcap(ByteView file) {
  return pcap_order(file).has_value();
}

Frames read_pcap(ByteView file) {
  Frames frames;
  frames.format = "pcap";
  const auto order = pcap_order(file).value_or(ByteOrder::Little);
  if (file.size() < pcap_head) {
    frames.cut = true;
    return frames;
  }
  const Duration::rep fraction = read32(order, file, 0) == pcap_nanos ? 1 : 1000; // ns
  const auto link = read32(order, file, 20) & UINT16_MAX; // the upper bits describe frame checks
  for (file = file.subspan(pcap_head); !file.empty();) {
    const auto size = file.size() < pcap_record ? 0 : read32(order, file, 8);
    if (file.size() < pcap_record || size > file.size() - pcap_record) {
      frames.cut = true;
      break;
    }
    add_frame(frames, link, 0,
              std::chrono::seconds{read32(order, file, 0)} +
                  Duration{Duration::rep{read32(order, file, 4)} * fraction},
              file.subspan(pcap_record, size));
    file = file.subspan(pcap_record + size);
  }
  return frames;
}

bool is_pcapng(ByteView file) {
  return file.size() >= sizeof section_block && read_u32(file, 0) == section_block;
}

Frames read_pcapng(ByteView file) {
  Frames frames;
  frames.format = "pcapng";
  auto order = ByteOrder::Little;
  std::optional<Section> section;
  while (!file.empty()) {
    if (file.size() < block_ends) {
      frames.cut = true;
      break;
    }
    if (is_pcapng(file)) {
      order = read_le32(file, block_head) == section_order ? ByteOrder::Little : ByteOrder::Big;
      section.emplace(order, frames);
    }
    const auto size = read32(order, file, 4);
    if (size < block_ends || size % 4 != 0 || size > file.size()) {
      frames.cut = true;
      break;
    }
    if (section)
      section->take(read32(order, file, 0), file.subspan(block_head, size - block_ends));
    file = file.subspan(size);
  }
  return frames;
}

} // namespace orb::protocol
