// HCI: events about connections and names, ACL data, and L2CAP inside it. Source: the Bluetooth
// Core Specification, volume 4 part E (HCI) and volume 3 part A (L2CAP).

#include "protocol/capture/connections.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace orb::protocol {
namespace {

// Events, and subevents of le_meta. Source: volume 4 part E, 7.7.
constexpr std::uint8_t connection_complete = 0x03;      // classic Bluetooth
constexpr std::uint8_t disconnection_complete = 0x05;   // both
constexpr std::uint8_t remote_name = 0x07;              // classic Bluetooth
constexpr std::uint8_t le_meta = 0x3E;                  // Bluetooth LE, with a subevent:
constexpr std::uint8_t le_connection_complete = 0x01;   // connected
constexpr std::uint8_t le_advertising = 0x02;           // advertising report
constexpr std::uint8_t le_enhanced_connection = 0x0A;   // connected
constexpr std::uint8_t le_extended_advertising = 0x0D;  // advertising report
constexpr std::uint8_t le_enhanced_connection_2 = 0x29; // connected

constexpr std::size_t address_size = 6;
constexpr std::uint16_t handle_bits = 0x0FFF; // the higher bits are flags

/// Formats an address, which is stored last byte first.
std::string address_at(ByteView bytes, std::size_t at) {
  return fmt::format("{:02X}:{:02X}:{:02X}:{:02X}:{:02X}:{:02X}", bytes[at + 5], bytes[at + 4],
                     bytes[at + 3], bytes[at + 2], bytes[at + 1], bytes[at]);
}

/// Extracts the name from advertising data: fields of length, type and data.
std::string advertised_name(ByteView fields) {
  constexpr std::uint8_t short_name = 8;
  constexpr std::uint8_t whole_name = 9;
  while (fields.size() >= 2 && fields[0] != 0 && fields[0] < fields.size()) {
    if (fields[1] == short_name || fields[1] == whole_name)
      return std::string(as_text(fields.subspan(2, fields[0] - std::size_t{1})));
    fields = fields.subspan(fields[0] + std::size_t{1});
  }
  return {};
}

class Follower {
public:
  void take(const HciPacket& packet) {
    if (packet.type == HciType::Event)
      take_event(packet);
    else if (packet.type == HciType::Acl)
      take_acl(packet);
  }

  Connections result;

private:
  /// A handle identifies a connection while it lasts.
  using Handle = std::pair<std::uint32_t, std::uint16_t>; ///< adapter, number

  struct Half {
    Bytes bytes;
    std::size_t size = 0; ///< including the header; 0: the beginning was not captured
  };

  void connect(Handle handle, std::string address) {
    open_[handle] = result.all.size();
    auto& connection = result.all.emplace_back();
    connection.address = std::move(address);
    connection.has_start = true;
    halves_.erase(halves_.lower_bound({handle, 0}), halves_.upper_bound({handle, UINT8_MAX}));
  }

  void disconnect(Handle handle) {
    const auto found = open_.find(handle);
    if (found == open_.end())
      return;
    result.all[found->second].has_end = true;
    open_.erase(found);
  }

  Connection& connection(Handle handle) {
    const auto [place, is_new] = open_.emplace(handle, result.all.size());
    if (is_new) // the capture began later
      result.all.emplace_back();
    return result.all[place->second];
  }

  void name(const std::string& address, std::string name) {
    while (name.ends_with('\0'))
      name.pop_back();
    if (!name.empty())
      result.names.emplace(address, std::move(name));
  }

  void take_event(const HciPacket& packet) {
    constexpr std::size_t head = 2; // code, size
    if (packet.bytes.size() < head)
      return;
    const auto body = packet.bytes.subspan(head);
    const auto handle_at = [&](std::size_t at) {
      return Handle{packet.adapter, static_cast<std::uint16_t>(read_le16(body, at) & handle_bits)};
    };
    switch (packet.bytes[0]) {
    case connection_complete: // status, handle, address
      if (body.size() >= 3 + address_size && body[0] == 0)
        connect(handle_at(1), address_at(body, 3));
      break;
    case disconnection_complete: // status, handle
      if (body.size() >= 3 && body[0] == 0)
        disconnect(handle_at(1));
      break;
    case remote_name: // status, address, name
      if (constexpr std::size_t name_at = 1 + address_size; body.size() > name_at && body[0] == 0) {
        const auto text = as_text(body.subspan(name_at));
        name(address_at(body, 1), std::string(text.substr(0, text.find('\0'))));
      }
      break;
    case le_meta:
      if (!body.empty())
        take_le(packet.adapter, body[0], body.subspan(1));
      break;
    default: break;
    }
  }

  void take_le(std::uint32_t adapter, std::uint8_t code, ByteView body) {
    switch (code) {
    case le_connection_complete:
    case le_enhanced_connection:
    case le_enhanced_connection_2: // status, handle, role, kind of address, address
      if (body.size() >= 5 + address_size && body[0] == 0)
        connect({adapter, static_cast<std::uint16_t>(read_le16(body, 1) & handle_bits)},
                address_at(body, 5));
      break;
    case le_advertising: take_reports(body, 2, 9); break;
    case le_extended_advertising: take_reports(body, 3, 24); break;
    default: break;
    }
  }

  /// Takes an advertising report. `address` and `data` are offsets of its address and its data,
  /// which their size precedes. Events with several reports are rare; only the first is read.
  void take_reports(ByteView body, std::size_t address, std::size_t data) {
    const auto report = body.empty() ? body : body.subspan(1); // skip the number of reports
    if (report.size() < data || report[data - 1] > report.size() - data)
      return;
    name(address_at(report, address), advertised_name(report.subspan(data, report[data - 1])));
  }

  void take_acl(const HciPacket& packet) {
    constexpr std::size_t head = 4; // handle with flags, size
    constexpr unsigned flags_at = 12;
    constexpr unsigned goes_on = 1;
    if (packet.bytes.size() < head)
      return;
    const auto word = read_le16(packet.bytes, 0);
    const Handle handle{packet.adapter, static_cast<std::uint16_t>(word & handle_bits)};
    const unsigned boundary = word >> flags_at & 3U;
    auto way = packet.way;
    if (!way) { // over Bluetooth LE computers start with 0, controllers with 2
      auto& last = ways_[handle];
      last = boundary == goes_on ? last : boundary == 0 ? Way::Sent : Way::Received;
      way = last;
    }
    auto& half = halves_[{handle, static_cast<std::uint8_t>(*way)}];
    const auto data = packet.bytes.subspan(head);
    if (boundary != goes_on)
      half = {};
    else if (half.bytes.empty())
      return;
    half.bytes.insert(half.bytes.end(), data.begin(), data.end());
    constexpr std::size_t l2cap_head = 4; // size, channel
    if (half.bytes.size() < l2cap_head)
      return;
    const auto size = l2cap_head + read_le16(half.bytes, 0);
    if (half.bytes.size() < size)
      return;
    L2capPacket whole{packet.frame, packet.at, packet.way, read_le16(half.bytes, 2), {}};
    whole.bytes.assign(half.bytes.begin() + l2cap_head,
                       half.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    half = {};
    connection(handle).packets.push_back(std::move(whole));
  }

  std::map<Handle, std::size_t> open_; ///< index in the result
  std::map<std::pair<Handle, std::uint8_t>, Half> halves_;
  std::map<Handle, Way> ways_;
};

} // namespace

Connections read_connections(const std::vector<HciPacket>& packets) {
  Follower follower;
  for (const auto& packet : packets)
    follower.take(packet);
  return std::move(follower.result);
}

} // namespace orb::protocol
