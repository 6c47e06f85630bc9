// The Attribute Protocol. Source: the Bluetooth Core Specification, volume 3 part F.

#include "protocol/capture/carriers.h"

#include "protocol/packet_v2.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::protocol {
namespace {

constexpr std::uint8_t found_information = 0x05; // a response
constexpr std::uint8_t read_by_type = 0x09;      // a response
constexpr std::uint8_t write_request = 0x12;     // sent by the client
constexpr std::uint8_t write_command = 0x52;     // … without an answer
constexpr std::uint8_t notification = 0x1B;      // sent by the device

constexpr std::size_t handle_size = 2;
constexpr std::size_t uuid_size = 16;

/// Returns the robot's characteristic with this UUID, which is stored last byte first.
std::optional<spec::BleCharacteristic> characteristic_of(ByteView uuid) {
  std::string text;
  for (std::size_t i = uuid_size; i-- > 0;) {
    text += fmt::format("{:02x}", uuid[i]);
    for (const std::size_t parted : {12U, 10U, 8U, 6U})
      if (i == parted)
        text += '-';
  }
  for (const auto& row : spec::ble_characteristics)
    if (row.uuid == text)
      return row.characteristic;
  return std::nullopt;
}

/// Parses handles with UUIDs. Short UUIDs are standard ones, never a robot's.
void learn_information(ByteView body, Attributes& known) {
  constexpr std::uint8_t long_uuids = 2;
  if (body.empty() || body[0] != long_uuids)
    return;
  constexpr auto entry = handle_size + uuid_size;
  for (body = body.subspan(1); body.size() >= entry; body = body.subspan(entry))
    known[read_le16(body, 0)] = characteristic_of(body.subspan(handle_size, uuid_size));
}

/// Parses characteristic declarations: handle, properties, value handle, UUID.
void learn_declarations(ByteView body, Attributes& known) {
  constexpr std::size_t value_at = handle_size + 1;
  constexpr std::size_t uuid_at = value_at + handle_size;
  constexpr auto long_entry = uuid_at + uuid_size;
  constexpr auto short_entry = uuid_at + 2;
  const std::size_t entry = body.empty() ? 0 : body[0];
  if (entry != long_entry && entry != short_entry)
    return;
  for (body = body.subspan(1); body.size() >= entry; body = body.subspan(entry)) {
    const auto value = read_le16(body, value_at);
    if (value != read_le16(body, 0) + 1) // true of declarations, but not of other answers
      return;
    known[value] =
        entry == long_entry ? characteristic_of(body.subspan(uuid_at, uuid_size)) : std::nullopt;
  }
}

/// A write by a client, or a notification by a device.
struct AttributeAccess {
  const L2capPacket* packet;
  Direction direction;
  std::uint16_t handle;
  ByteView bytes;
};

std::vector<AttributeAccess> pieces_of(const Connection& connection) {
  constexpr std::size_t head = 1 + handle_size;
  std::vector<AttributeAccess> pieces;
  for (const auto& packet : connection.packets) {
    if (packet.channel != att_channel || packet.bytes.size() < head)
      continue;
    const auto opcode = packet.bytes[0];
    const bool writes = opcode == write_request || opcode == write_command;
    if (writes || opcode == notification)
      pieces.push_back({&packet, writes ? Direction::ToBall : Direction::FromBall,
                        read_le16(packet.bytes, 1), ByteView(packet.bytes).subspan(head)});
  }
  return pieces;
}

/// Guesses from the traffic which handles carry packets or a greeting.
std::map<std::uint16_t, bool> guess(const std::vector<AttributeAccess>& pieces) {
  std::map<std::pair<std::uint16_t, Direction>, Bytes> streams;
  std::map<std::uint16_t, bool> robot;
  for (const auto& piece : pieces) {
    auto& stream = streams[{piece.handle, piece.direction}];
    stream.insert(stream.end(), piece.bytes.begin(), piece.bytes.end());
    robot[piece.handle] |= spec::is_greeting(as_text(piece.bytes));
  }
  for (const auto& [key, bytes] : streams)
    robot[key.first] |= understood(bytes, key.second) > 0 || understood_as_v2(bytes) > 0;
  return robot;
}

/// The role of a piece. nullopt if it is not a robot's.
enum class Role : std::uint8_t { Packets, Greeting };
std::optional<Role> role_of(spec::BleCharacteristic characteristic) {
  using spec::BleCharacteristic;
  switch (characteristic) {
  case BleCharacteristic::AntiDos:
  case BleCharacteristic::AntiDosV2:
  case BleCharacteristic::TxPower:
  case BleCharacteristic::Wake: return Role::Greeting;
  case BleCharacteristic::Commands:
  case BleCharacteristic::Answers:
  case BleCharacteristic::PacketsV2: return Role::Packets;
  }
  return std::nullopt;
}

} // namespace

void learn_attributes(const Connection& connection, Attributes& known) {
  for (const auto& packet : connection.packets) {
    if (packet.channel != att_channel || packet.bytes.empty())
      continue;
    const auto body = ByteView(packet.bytes).subspan(1);
    if (packet.bytes[0] == found_information)
      learn_information(body, known);
    else if (packet.bytes[0] == read_by_type)
      learn_declarations(body, known);
  }
}

Conversation read_gatt(const Connection& connection, const Attributes& known) {
  Conversation conversation;
  conversation.carrier = Carrier::Gatt;
  conversation.robot = connection.address;
  conversation.has_start = connection.has_start;
  conversation.has_end = connection.has_end;
  conversation.has_lock = std::any_of(known.begin(), known.end(), [](const auto& attribute) {
    return attribute.second == spec::BleCharacteristic::AntiDos ||
           attribute.second == spec::BleCharacteristic::AntiDosV2;
  });
  const auto pieces = pieces_of(connection);
  auto guessed = guess(pieces);
  for (const auto& piece : pieces) {
    const auto attribute = known.find(piece.handle);
    std::optional<Role> role;
    if (attribute != known.end()) {
      if (attribute->second)
        role = role_of(*attribute->second);
    } else if (guessed[piece.handle])
      role = spec::is_greeting(as_text(piece.bytes)) ? Role::Greeting : Role::Packets;
    if (!role)
      continue;
    LogLine line;
    line.direction = piece.direction;
    line.bytes.assign(piece.bytes.begin(), piece.bytes.end());
    line.at = piece.packet->at;
    line.number = piece.packet->frame;
    line.greets = role == Role::Greeting;
    conversation.lines.push_back(std::move(line));
  }
  return conversation;
}

} // namespace orb::protocol
