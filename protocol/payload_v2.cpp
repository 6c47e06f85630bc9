#include "protocol/payload_v2.h"

#include "base/text/text.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <optional>

namespace orb::protocol {
namespace {

using spec::V2Type;

std::optional<std::int64_t> read_integer(std::string_view word) {
  std::int64_t value = 0;
  const bool is_hex = word.starts_with("0x") || word.starts_with("0X");
  constexpr int hexadecimal = 16;
  constexpr int decimal = 10;
  const auto digits = word.substr(is_hex ? 2 : 0);
  const auto* end = digits.data() + digits.size();
  const auto [next, error] =
      std::from_chars(digits.data(), end, value, is_hex ? hexadecimal : decimal);
  return error == std::errc{} && next == end ? std::optional(value) : std::nullopt;
}

std::string takes(const spec::V2Field& field) {
  switch (field.type) {
  case V2Type::Text:
    return fmt::format("`{}` takes text of at most {} bytes", field.name, field.most);
  case V2Type::Data:
    return fmt::format("`{}` takes at most {} hex bytes such as FF0000", field.name, field.most);
  case V2Type::F32:
    return fmt::format("`{}` takes a number from {} to {}", field.name, field.least, field.most);
  case V2Type::U8:
  case V2Type::U16:
  case V2Type::U32:
  case V2Type::S16: break;
  }
  return fmt::format("`{}` takes a whole number from {} to {}", field.name, field.least,
                     field.most);
}

bool append_field(Bytes& out, const spec::V2Field& field, const std::string& word) {
  const auto most = static_cast<std::size_t>(std::max<std::int64_t>(field.most, 0));
  if (field.type == V2Type::Text) {
    const auto bytes = as_bytes(word);
    if (bytes.size() > most)
      return false;
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.push_back(0);
    return true;
  }
  if (field.type == V2Type::Data) {
    const auto bytes = from_hex(word);
    if (!bytes || bytes->size() > most ||
        bytes->size() < static_cast<std::size_t>(std::max<std::int64_t>(field.least, 0)))
      return false;
    out.insert(out.end(), bytes->begin(), bytes->end());
    return true;
  }
  if (field.type == V2Type::F32) {
    const auto value = parse_real(word);
    if (!value || !(*value >= static_cast<double>(field.least)) ||
        !(*value <= static_cast<double>(field.most)))
      return false;
    append_f32(out, *value);
    return true;
  }
  const auto value = read_integer(word);
  if (!value || *value < field.least || *value > field.most)
    return false;
  switch (width_of(field.type)) {
  case 1: out.push_back(static_cast<std::uint8_t>(*value)); break;
  case 2: append_u16(out, static_cast<std::uint32_t>(*value)); break;
  default: append_u32(out, static_cast<std::uint32_t>(*value)); break;
  }
  return true;
}

bool values_fit(spec::V2Command command, ByteView data) {
  std::size_t at = 0;
  for (const auto& field : spec::v2_operands) {
    if (field.command != command)
      continue;
    std::int64_t value = 0;
    if (field.type == V2Type::U8)
      value = data[at++];
    else if (field.type == V2Type::U16) {
      value = read_u16(data, at);
      at += 2;
    } else if (field.type == V2Type::F32) {
      const double number = read_f32(data, at);
      at += sizeof(float);
      if (!(number >= static_cast<double>(field.least) &&
            number <= static_cast<double>(field.most)))
        return false;
      continue;
    } else
      return true; // this field takes all remaining bytes
    if (value < field.least || value > field.most)
      return false;
  }
  return true;
}

} // namespace

std::size_t width_of(V2Type type) {
  switch (type) {
  case V2Type::U8: return 1;
  case V2Type::U16:
  case V2Type::S16: return 2;
  case V2Type::U32:
  case V2Type::F32: return 4;
  case V2Type::Text:
  case V2Type::Data: return 0;
  }
  return 0;
}

void append_f32(Bytes& out, double value) {
  const auto number = static_cast<float>(value);
  static_assert(sizeof number == sizeof(std::uint32_t));
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  append_u32(out, bits);
}

double read_f32(ByteView bytes, std::size_t offset) {
  const auto bits = read_u32(bytes, offset);
  float number = 0;
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

tl::expected<Bytes, std::string> encode_operands(spec::V2Command command,
                                                 std::span<const std::string> words) {
  Bytes out;
  std::size_t at = 0;
  for (const auto& field : spec::v2_operands) {
    if (field.command != command)
      continue;
    const bool may_be_absent = width_of(field.type) == 0 && field.type == V2Type::Data;
    if (at == words.size() && may_be_absent)
      continue;
    const bool given = at < words.size();
    if (!given && field.least > 0)
      return tl::unexpected(takes(field));
    static const std::string zero = "0";
    static const std::string nothing;
    if (!append_field(out, field, given ? words[at] : field.type == V2Type::Text ? nothing : zero))
      return tl::unexpected(given ? fmt::format("unexpected `{}`; {}", words[at], takes(field))
                                  : takes(field));
    at += given ? 1 : 0;
  }
  if (at < words.size())
    return tl::unexpected(fmt::format("unexpected `{}` after the last operand of {}; it takes {}",
                                      words[at], spec::info(command).name,
                                      at == 0 ? "none" : std::to_string(at)));
  return out;
}

PacketV2 make_request(spec::V2Command command, Bytes data, std::uint8_t seq, std::uint8_t flags) {
  PacketV2 packet;
  packet.flags =
      static_cast<std::uint8_t>(flags | static_cast<std::uint8_t>(spec::V2Flag::Activity));
  packet.did = spec::info(command).did();
  packet.cid = spec::info(command).cid();
  packet.seq = seq;
  packet.data = std::move(data);
  return packet;
}

PacketV2 address(PacketV2 request, const spec::RobotInfo& robot) {
  const auto* row = spec::find_v2_command(request.did, request.cid);
  if (robot.targets != spec::Targets::Both || row == nullptr)
    return request;
  request.flags |= static_cast<std::uint8_t>(spec::V2Flag::HasTarget);
  request.flags |= static_cast<std::uint8_t>(spec::V2Flag::HasSource);
  request.target = spec::v2_target(row->processor);
  request.source = spec::v2_client;
  return request;
}

bool fits(spec::V2Command command, ByteView data) {
  std::size_t least = 0;
  std::size_t more = 0;
  for (const auto& field : spec::v2_operands) {
    if (field.command != command)
      continue;
    least += width_of(field.type);
    if (field.type == V2Type::Data)
      least += static_cast<std::size_t>(field.least);
    if (width_of(field.type) == 0)
      more = static_cast<std::size_t>(field.most - field.least) + 1; // the NUL of a text
  }
  return data.size() >= least && data.size() <= least + more;
}

spec::V2Error refusal(spec::V2Command command, ByteView data) {
  using spec::V2Error;
  if (!fits(command, data))
    return V2Error::BadLength;
  return values_fit(command, data) ? V2Error::Success : V2Error::BadParameter;
}

spec::V2Error refusal(const PacketV2& request, const spec::RobotInfo& robot) {
  using spec::V2Error;
  const bool targeted = spec::has(request.flags, spec::V2Flag::HasTarget);
  const auto first = spec::v2_target(spec::V2Processor::Primary);
  const auto second = spec::v2_target(spec::V2Processor::Secondary);
  // Most robots with one processor also accept the address of the second: clients of real ones use
  // it.
  if (targeted && request.target != first &&
      (request.target != second || robot.targets == spec::Targets::First))
    return V2Error::BadTarget;
  if (std::none_of(spec::v2_commands.begin(), spec::v2_commands.end(),
                   [&](const auto& row) { return row.did() == request.did; }))
    return V2Error::BadDevice;
  const auto* row = spec::find_v2_command(request.did, request.cid);
  if (row == nullptr || !spec::knows(robot, *row))
    return V2Error::BadCommand;
  const bool is_rvr = robot.sensors == spec::RobotSensors::Services;
  // Handled by its first processor.
  const bool lamps_of_rvr = is_rvr && row->command == spec::V2Command::MatrixColor;
  if (targeted && robot.targets == spec::Targets::Both &&
      row->processor != spec::V2Processor::Any &&
      request.target != spec::v2_target(row->processor) && !lamps_of_rvr)
    return V2Error::BadCommand;
  return refusal(row->command, request.data);
}

bool serves_asleep(std::uint8_t did) {
  const auto power = spec::info(spec::V2Command::Wake).did();
  return did <= power;
}

} // namespace orb::protocol
