#include "protocol/describe.h"

#include "protocol/payload.h"
#include "spec/basic.h"

#include <fmt/format.h>

namespace orb::protocol {
namespace {

/// Quotes text, with escapes for unprintable bytes.
std::string quoted(ByteView bytes) {
  std::string out = "\"";
  for (const auto byte : bytes) {
    if (byte == '\n')
      out += "\\n";
    else if (byte == '\r')
      out += "\\r";
    else if (byte == 0)
      out += "\\0";
    else if (byte == '"' || byte == '\\')
      out += {'\\', static_cast<char>(byte)};
    else if (byte < ' ' || byte >= '\x7F')
      out += fmt::format("\\x{:02X}", byte);
    else
      out += static_cast<char>(byte);
  }
  return out + "\"";
}

/// Returns the meaning of a field's number; empty for a plain number.
std::string meaning(const FieldValue& value) {
  const auto bits = static_cast<std::uint32_t>(value.number);
  if (value.field->unit == "nibbles")
    return fmt::format("{}.{}", value.number >> 4, value.number & 15);
  if (value.field->unit == "orbBasic error")
    if (const auto error = spec::find_error(bits))
      return std::string(spec::info(*error).text);
  const auto name = std::string(spec::value_name(value.field->unit, bits));
  return name.empty() ? spec::bit_names(value.field->unit, bits) : name;
}

std::string value_text(const FieldValue& value) {
  const auto& field = *value.field;
  if (!spec::is_number(field.type)) {
    const auto is_text = field.unit == "text";
    return is_text ? quoted(value.bytes) : to_hex(value.bytes);
  }
  if (field.unit == "nibbles")
    return meaning(value);
  const auto bits = static_cast<std::uint32_t>(value.number);
  const auto name = meaning(value);
  const auto is_mask = field.unit.starts_with("stream mask") || field.unit.ends_with("flags");
  const auto number = is_mask ? fmt::format("{:0{}X}h", bits, 2 * spec::field_size(field.type))
                              : fmt::format("{}", value.number);
  return name.empty() ? number : fmt::format("{} ({})", number, name);
}

std::size_t size_of(const FieldValue& value) {
  return spec::is_number(value.field->type) ? spec::field_size(value.field->type)
                                            : value.bytes.size();
}

/// Converts bytes to text: drops trailing NULs and maps bytes beyond ASCII to U+0080 to U+00FF.
std::string plain_text(ByteView bytes) {
  std::string out;
  while (!bytes.empty() && bytes.back() == 0)
    bytes = bytes.first(bytes.size() - 1);
  for (const auto byte : bytes) {
    if (byte < 0x80) { // ASCII
      out += static_cast<char>(byte);
      continue;
    }
    out += static_cast<char>(0xC0 | byte >> 6);     // UTF-8: the upper bits
    out += static_cast<char>(0x80 | (byte & 0x3F)); // UTF-8: the lower bits
  }
  return out;
}

Parts parts_of(std::string_view name, std::span<const spec::Field> fields, ByteView data) {
  Parts parts{name, {}, {}};
  for (const auto& value : read_fields(fields, data)) {
    const auto size = size_of(value);
    data = data.subspan(size);
    if (value.field->name.starts_with("reserved"))
      continue;
    NamedValue named{std::string(value.field->name), std::nullopt, {}};
    if (spec::is_number(value.field->type)) {
      named.number = value.number;
      named.text = meaning(value);
    } else {
      named.text = value.field->unit == "text" ? plain_text(value.bytes) : to_hex(value.bytes);
    }
    parts.fields.push_back(std::move(named));
  }
  parts.rest.assign(data.begin(), data.end());
  return parts;
}

/// Formats the data as `name value` with commas, followed by bytes that no field covers.
std::string fields_text(std::span<const spec::Field> fields, ByteView data) {
  std::string out;
  std::size_t used = 0;
  for (const auto& value : read_fields(fields, data)) {
    used += size_of(value);
    if (value.field->name.starts_with("reserved"))
      continue;
    out += fmt::format(", {} {}", value.field->name, value_text(value));
  }
  if (used < data.size())
    out += fmt::format(", data {}", to_hex(data.subspan(used)));
  return out;
}

/// Formats the frames of a sensor stream according to its mask.
std::string frames_text(std::uint64_t mask, ByteView data) {
  std::string out;
  std::size_t at = 0;
  while (at < data.size()) {
    const auto start = at;
    for (const auto& row : spec::streams) {
      if ((row.mask & mask) == 0)
        continue;
      if (data.size() - at < 2)
        return out + fmt::format(", data {}", to_hex(data.subspan(at)));
      out += fmt::format(", {} {}", row.name, static_cast<std::int16_t>(read_u16(data, at)));
      at += 2;
    }
    if (at == start)
      return out + fmt::format(", frames {}", to_hex(data));
  }
  return out;
}

/// Converts the frames of a stream to fields: the names repeat for each frame.
Parts stream_parts(std::string_view name, std::uint64_t mask, ByteView data) {
  Parts parts{name, {}, {}};
  for (bool more = true; more && !data.empty();) {
    more = false;
    for (const auto& row : spec::streams)
      if ((row.mask & mask) != 0 && data.size() >= 2) {
        parts.fields.push_back(
            {std::string(row.name), static_cast<std::int16_t>(read_u16(data, 0)), {}});
        data = data.subspan(2);
        more = true;
      }
  }
  parts.rest.assign(data.begin(), data.end());
  return parts;
}

std::string options_text(std::uint8_t flags) {
  const auto answer = (flags & spec::sop2_answer) != 0;
  const auto reset = (flags & spec::sop2_reset_timeout) != 0;
  return fmt::format("{:02X} ({}, {})", flags, answer ? "answer" : "no answer",
                     reset ? "reset time-out" : "keep time-out");
}

std::uint8_t check_byte(const Item& item) {
  return item.raw.back();
}

} // namespace

std::string Describer::describe(const Item& item) {
  switch (item.kind) {
  case Item::Kind::Command: return command(item);
  case Item::Kind::Response: return response(item);
  case Item::Kind::Async: return async(item);
  case Item::Kind::Noise: return fmt::format("noise {}", to_hex(item.raw));
  case Item::Kind::BadChecksum:
    return fmt::format(
        "bad checksum {}, expected {:02X}", to_hex(item.raw),
        checksum(item.raw.subspan(spec::sop_size, item.raw.size() - spec::sop_size - 1)));
  case Item::Kind::Fragment: return fmt::format("incomplete {}", to_hex(item.raw));
  }
  return {};
}

void Describer::remember(const Item& item) {
  const auto* row = spec::find_command(item.did, item.cid);
  asked_[item.seq] = row;
  if (row != nullptr && row->command == spec::ApiCommand::SetDataStreaming) {
    std::uint64_t mask = 0;
    for (const auto& value : read_fields(spec::operands(row->command), item.data)) {
      if (value.field->unit == "stream mask")
        mask |= static_cast<std::uint64_t>(value.number);
      if (value.field->unit == "stream mask 2")
        mask |= static_cast<std::uint64_t>(value.number) << 32;
    }
    stream_mask_ = mask;
  }
}

Parts Describer::parts(const Item& item) {
  using Fields = std::span<const spec::Field>;
  if (item.kind == Item::Kind::Command) {
    remember(item);
    const auto* row = spec::find_command(item.did, item.cid);
    return row == nullptr ? parts_of({}, {}, item.data)
                          : parts_of(row->name, spec::operands(row->command), item.data);
  }
  if (item.kind == Item::Kind::Response) {
    const auto* row = asked_[item.seq];
    const auto ok = item.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
    return parts_of(row == nullptr ? std::string_view() : row->name,
                    row == nullptr || !ok ? Fields{} : spec::answer(row->command), item.data);
  }
  const auto* row = item.kind == Item::Kind::Async ? spec::find_async(item.code) : nullptr;
  if (row == nullptr)
    return parts_of({}, {}, item.data);
  return row->id == spec::AsyncId::SensorData
             ? stream_parts(row->name, stream_mask_, item.data)
             : parts_of(row->name, spec::fields(row->id), item.data);
}

std::string Describer::command(const Item& item) {
  const auto* row = spec::find_command(item.did, item.cid);
  remember(item);
  return fmt::format(
      "command {}: sop2 {}, did {:02X}, cid {:02X}, seq {:02X}, dlen {:02X}{}, chk {:02X}",
      row == nullptr ? "unknown" : row->name, options_text(item.flags), item.did, item.cid,
      item.seq, item.raw[spec::command_header_size - 1],
      row == nullptr ? fields_text({}, item.data)
                     : fields_text(spec::operands(row->command), item.data),
      check_byte(item));
}

std::string Describer::response(const Item& item) {
  const auto* code = spec::find_response(item.code);
  const auto* row = asked_[item.seq];
  const auto ok = item.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
  const auto fields =
      row == nullptr || !ok ? std::span<const spec::Field>{} : spec::answer(row->command);
  return fmt::format(
      "response{}: sop2 {:02X}, mrsp {:02X} ({}), seq {:02X}, dlen {:02X}{}, chk {:02X}",
      row == nullptr ? "" : fmt::format(" to {}", row->name), item.flags, item.code,
      code == nullptr ? "unknown" : code->meaning, item.seq,
      item.raw[spec::response_header_size - 1], fields_text(fields, item.data), check_byte(item));
}

std::string Describer::async(const Item& item) const {
  const auto* row = spec::find_async(item.code);
  const auto fields = row == nullptr ? std::span<const spec::Field>{} : spec::fields(row->id);
  const auto is_stream = row != nullptr && row->id == spec::AsyncId::SensorData;
  return fmt::format("message {}: sop2 {:02X}, id {:02X}, dlen {:04X}{}, chk {:02X}",
                     row == nullptr ? "unknown" : row->name, item.flags, item.code,
                     read_u16(item.raw, spec::async_header_size - 2),
                     is_stream ? frames_text(stream_mask_, item.data)
                               : fields_text(fields, item.data),
                     check_byte(item));
}

} // namespace orb::protocol
