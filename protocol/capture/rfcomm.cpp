// RFCOMM, the serial port of classic Bluetooth. Source: the Bluetooth specification of RFCOMM and
// 3GPP TS 07.10. Its L2CAP channel is recognised by the checksums of its frames.

#include "protocol/capture/carriers.h"

#include <algorithm>
#include <array>

namespace orb::protocol {
namespace {

/// A data frame of a channel.
struct Data {
  std::uint8_t channel = 0;
  ByteView bytes;
};

/// Computes the checksum of the first two bytes of a frame.
std::uint8_t frame_check(ByteView bytes) {
  constexpr unsigned polynomial = 0xE0; // x^8 + x^2 + x + 1, bits reversed
  constexpr unsigned ones = 0xFF;       // the initial value; the result is subtracted from it
  unsigned check = ones;
  for (const auto byte : bytes) {
    check ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      check = (check >> 1U) ^ ((check & 1U) != 0 ? polynomial : 0U);
  }
  return static_cast<std::uint8_t>(ones - check);
}

std::optional<Data> data_of(ByteView frame) {
  constexpr std::uint8_t data_frame = 0xEF;   // UIH
  constexpr std::uint8_t with_credits = 0xFF; // UIH with a credit byte before the data
  constexpr std::size_t shortest = 4;         // address, control, size, checksum
  if (frame.size() < shortest || (frame[1] != data_frame && frame[1] != with_credits) ||
      frame_check(frame.first(2)) != frame.back())
    return std::nullopt;
  constexpr unsigned size_bits = 7;
  const bool is_short = (frame[2] & 1U) != 0;
  std::size_t at = is_short ? 3 : 4;
  const std::size_t size = static_cast<std::size_t>(frame[2] >> 1U) |
                           (is_short ? 0 : static_cast<std::size_t>(frame[3]) << size_bits);
  at += frame[1] == with_credits ? 1 : 0;
  constexpr unsigned number_at = 2; // below are two flag bits of the address
  const auto channel = static_cast<std::uint8_t>(frame[0] >> number_at);
  if (channel == 0 || at + size + 1 != frame.size()) // channel 0 controls the others
    return std::nullopt;
  return Data{channel, frame.subspan(at, size)};
}

bool has_packets(const Conversation& conversation) {
  for (const auto direction : {Direction::ToBall, Direction::FromBall}) {
    Bytes bytes;
    for (const auto& line : conversation.lines)
      if (line.direction.value_or(direction) == direction)
        bytes.insert(bytes.end(), line.bytes.begin(), line.bytes.end());
    if (understood(bytes, direction) > 0)
      return true;
  }
  return false;
}

} // namespace

std::vector<Conversation> read_rfcomm(const Connection& connection) {
  std::map<std::uint8_t, Conversation> channels;
  for (const auto& packet : connection.packets) {
    const auto data = packet.channel < first_agreed_channel ? std::nullopt : data_of(packet.bytes);
    if (!data || data->bytes.empty())
      continue;
    LogLine line;
    if (packet.way)
      line.direction = *packet.way == Way::Sent ? Direction::ToBall : Direction::FromBall;
    line.bytes.assign(data->bytes.begin(), data->bytes.end());
    line.at = packet.at;
    line.number = packet.frame;
    channels[data->channel].lines.push_back(std::move(line));
  }
  std::vector<Conversation> found;
  for (auto& [channel, conversation] : channels) {
    if (!has_packets(conversation))
      continue;
    conversation.carrier = Carrier::Rfcomm;
    conversation.robot = connection.address;
    conversation.has_start = connection.has_start;
    conversation.has_end = connection.has_end;
    found.push_back(std::move(conversation));
  }
  return found;
}

} // namespace orb::protocol
