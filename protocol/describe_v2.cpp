#include "protocol/describe_v2.h"

#include "protocol/payload_v2.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::protocol {
namespace {

using spec::V2Command;
using spec::V2Message;
using spec::V2Type;

std::string flag_names(std::uint8_t flags) {
  std::string out;
  for (const auto& row : spec::v2_flags)
    if (spec::has(flags, row.flag))
      out += fmt::format("{}{}", out.empty() ? "" : ", ", row.name);
  return out.empty() ? "none" : out;
}

bool is_message(const PacketV2& packet) {
  return !spec::has(packet.flags, spec::V2Flag::Response) && packet.seq == spec::v2_message_seq;
}

void add(std::string& out, std::string_view name, std::string_view value) {
  out += fmt::format("{}{} {}", out.empty() ? "" : ", ", name, value);
}

V2Command what_of(const spec::V2Field& field) {
  return field.command;
}
V2Message what_of(const spec::V2Says& field) {
  return field.message;
}

/// Formats the fields of kind `what` in order, as far as the data reaches.
template <class Fields, class What>
std::string values(const Fields& fields, What what, ByteView data) {
  std::string out;
  std::size_t at = 0;
  for (const auto& field : fields) {
    if (what != what_of(field))
      continue;
    const auto size = width_of(field.type);
    if (data.size() - at < size || (size == 0 && at == data.size()))
      break;
    const auto rest = data.subspan(at);
    switch (field.type) {
    case V2Type::U8: add(out, field.name, std::to_string(rest[0])); break;
    case V2Type::U16: add(out, field.name, std::to_string(read_u16(rest, 0))); break;
    case V2Type::S16:
      add(out, field.name, std::to_string(static_cast<std::int16_t>(read_u16(rest, 0))));
      break;
    case V2Type::U32:
      add(out, field.name,
          field.name == "mask" ? fmt::format("{:08X}h", read_u32(rest, 0))
                               : std::to_string(read_u32(rest, 0)));
      break;
    case V2Type::F32: add(out, field.name, fmt::format("{:g}", read_f32(rest, 0))); break;
    case V2Type::Data: add(out, field.name, to_hex(rest)); break;
    case V2Type::Text: {
      const auto text = as_text(rest).substr(0, as_text(rest).find('\0'));
      const bool is_plain =
          std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
      add(out, field.name, is_plain ? fmt::format("`{}`", text) : to_hex(as_bytes(text)));
      break;
    }
    }
    at += size == 0 ? rest.size() : size;
  }
  if (at < data.size() && !out.empty())
    add(out, "and", to_hex(data.subspan(at)));
  return out;
}

} // namespace

std::string_view kind_of(const PacketV2& packet) {
  return spec::has(packet.flags, spec::V2Flag::Response) ? "response"
         : is_message(packet)                            ? "message"
                                                         : "command";
}

std::string_view name_of(const PacketV2& packet) {
  if (is_message(packet))
    if (const auto* message = spec::find_v2_message(packet.did, packet.cid))
      return message->name;
  const auto* row = spec::find_v2_command(packet.did, packet.cid);
  return row == nullptr ? std::string_view() : row->name;
}

/// Remembers requests that determine the content of later samples.
void DescriberV2::note(const PacketV2& packet) {
  const auto* row = spec::find_v2_command(packet.did, packet.cid);
  if (row == nullptr || is_message(packet) || spec::has(packet.flags, spec::V2Flag::Response) ||
      !fits(row->command, packet.data))
    return;
  constexpr std::size_t mask_at = 3;
  if (row->command == V2Command::StreamMask)
    mask_ = read_u32(packet.data, mask_at);
  if (row->command == V2Command::StreamExtended)
    extended_ = read_u32(packet.data, 0);
  if (row->command == V2Command::StreamClear)
    std::erase_if(services_, [&](const auto& one) { return one.first.first == packet.target; });
  if (row->command != V2Command::StreamConfigure)
    return;
  constexpr std::size_t entry = 3; // id and size
  constexpr int bits[] = {8, 16, 32};
  std::vector<Service> services;
  for (std::size_t at = 1; at + entry <= packet.data.size(); at += entry) {
    const auto* service = spec::find_v2_service(read_u16(packet.data, at));
    const auto size = packet.data[at + 2];
    if (service == nullptr || size >= std::size(bits))
      return;
    services.push_back({service, bits[size]});
  }
  services_[{packet.target, packet.data[0]}] = std::move(services);
}

std::string DescriberV2::sample(ByteView data) const {
  std::string out;
  std::size_t at = 0;
  for (const auto mask : {spec::V2Mask::Base, spec::V2Mask::Extended})
    for (std::uint32_t bit = 1U << 31; bit != 0; bit >>= 1) {
      if (((mask == spec::V2Mask::Base ? mask_ : extended_) & bit) == 0)
        continue;
      if (data.size() < at + sizeof(float))
        return {};
      const auto* row = spec::find_v2_sensor(mask, bit);
      const auto value = fmt::format("{:g}{}{}", read_f32(data, at),
                                     row == nullptr || row->unit.empty() ? "" : " ",
                                     row == nullptr ? std::string_view() : row->unit);
      add(out, row == nullptr ? fmt::format("bit {:X}h", bit) : std::string(row->name), value);
      at += sizeof(float);
    }
  return at == data.size() ? out : std::string();
}

std::string DescriberV2::service_sample(const PacketV2& packet) const {
  if (packet.data.empty())
    return {};
  const auto found = services_.find({packet.source, packet.data[0]});
  std::string out = fmt::format("token {}", packet.data[0]);
  if (found == services_.end())
    return packet.data.size() == 1
               ? out
               : fmt::format("{}, data {}", out, to_hex(ByteView(packet.data).subspan(1)));
  std::size_t at = 1;
  for (const auto& [row, bits] : found->second) {
    std::string numbers;
    for (std::size_t value = 0; value < row->values; ++value) {
      const auto bytes = static_cast<std::size_t>(bits) / 8;
      if (packet.data.size() < at + bytes)
        return {};
      std::uint32_t number = 0;
      for (const auto end = at + bytes; at < end; ++at)
        number = number << 8 | packet.data[at];
      const double part = number / (std::exp2(bits) - 1);
      numbers += fmt::format("{}{:.6g}", value == 0 ? "" : " ",
                             row->least(value) + part * (row->most(value) - row->least(value)));
    }
    add(out, row->name, numbers);
  }
  return at == packet.data.size() ? out : std::string();
}

std::string DescriberV2::fields_of(const PacketV2& packet) const {
  if (is_message(packet)) {
    const auto* row = spec::find_v2_message(packet.did, packet.cid);
    if (row == nullptr)
      return {};
    if (row->message == V2Message::Sample)
      return sample(packet.data);
    if (row->message == V2Message::ServiceSample)
      return service_sample(packet);
    auto data = packet.data;
    constexpr std::size_t with_short_time = 16;
    constexpr std::ptrdiff_t time_at = 14;
    if (row->message == V2Message::Collision && data.size() == with_short_time)
      data.insert(data.begin() + time_at, 2, 0);
    return values(spec::v2_says, row->message, data);
  }
  const auto* row = spec::find_v2_command(packet.did, packet.cid);
  if (row == nullptr || packet.error != 0)
    return {};
  return spec::has(packet.flags, spec::V2Flag::Response)
             ? values(spec::v2_answers, row->command, packet.data)
             : values(spec::v2_operands, row->command, packet.data);
}

std::string DescriberV2::describe(const ItemV2& item) {
  const auto& packet = item.packet;
  switch (item.kind) {
  case ItemV2::Kind::Noise: return fmt::format("noise {}", to_hex(item.raw));
  case ItemV2::Kind::Incomplete: return fmt::format("incomplete {}", to_hex(item.raw));
  case ItemV2::Kind::BadChecksum:
    return fmt::format("bad checksum {}, expected {:02X}", to_hex(item.raw), item.right_checksum);
  case ItemV2::Kind::Packet: break;
  }
  const auto name = name_of(packet);
  auto out = fmt::format("{}{}{}: flags {:02X} ({})", kind_of(packet), name.empty() ? "" : " ",
                         name, packet.flags, flag_names(packet.flags));
  if (!packet.extended_flags.empty())
    out += fmt::format(", extended flags {}", to_hex(packet.extended_flags));
  if (spec::has(packet.flags, spec::V2Flag::HasTarget))
    out += fmt::format(", tid {:02X} (port {}, node {})", packet.target, packet.target >> 4,
                       packet.target & 15);
  if (spec::has(packet.flags, spec::V2Flag::HasSource))
    out += fmt::format(", sid {:02X} (port {}, node {})", packet.source, packet.source >> 4,
                       packet.source & 15);
  out += fmt::format(", did {:02X}, cid {:02X}, seq {:02X}", packet.did, packet.cid, packet.seq);
  if (spec::has(packet.flags, spec::V2Flag::Response)) {
    const auto* error = spec::find_v2_error(packet.error);
    out += fmt::format(", err {:02X} ({})", packet.error,
                       error == nullptr ? "unknown" : error->meaning);
  }
  note(packet);
  if (const auto fields = fields_of(packet); !fields.empty())
    out += ", " + fields;
  else if (!packet.data.empty())
    out += fmt::format(", data {}", to_hex(packet.data));
  return out + fmt::format(", chk {:02X}", item.checksum);
}

} // namespace orb::protocol
