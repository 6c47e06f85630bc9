#include "protocol/payload.h"

#include "base/text/text.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <string_view>

namespace orb::protocol {
namespace {

using spec::Field;
using spec::FieldType;

std::int64_t read_number(FieldType type, ByteView data) {
  switch (type) {
  case FieldType::U8: return data[0];
  case FieldType::U16: return read_u16(data, 0);
  case FieldType::U32: return read_u32(data, 0);
  case FieldType::U64:
    return static_cast<std::int64_t>(std::uint64_t{read_u32(data, 0)} << 32 | read_u32(data, 4));
  case FieldType::S16: return static_cast<std::int16_t>(read_u16(data, 0));
  case FieldType::S32: return static_cast<std::int32_t>(read_u32(data, 0));
  case FieldType::Data:
  case FieldType::Data32:
  case FieldType::Text12:
  case FieldType::Text16: return 0;
  }
  return 0;
}

void append_number(Bytes& out, FieldType type, std::int64_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  switch (spec::field_size(type)) {
  case 8:
    append_u32(out, static_cast<std::uint32_t>(value >> 32));
    append_u32(out, bits);
    return;
  case 1: out.push_back(static_cast<std::uint8_t>(bits)); return;
  case 2: append_u16(out, bits); return;
  default: append_u32(out, bits);
  }
}

std::string placeholder(const Field& field) {
  std::string out(field.name);
  for (auto& c : out)
    c = c == ' ' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

/// Returns a named value of the field's type: `flash` for an area, `on` and `off` for a flag.
std::optional<std::int64_t> named_value(const Field& field, std::string_view word) {
  if (field.unit == "bool") {
    if (word == "on" || word == "true")
      return 1;
    if (word == "off" || word == "false")
      return 0;
    return std::nullopt;
  }
  for (auto value = field.least; value <= std::min<std::int64_t>(field.most, UINT8_MAX); ++value) {
    const auto name = spec::value_name(field.unit, static_cast<std::uint32_t>(value));
    if (!name.empty() && equal_words(name, word))
      return value;
  }
  return std::nullopt;
}

std::optional<std::int64_t> parse_value(std::string_view word) {
  const auto negative = word.starts_with('-');
  if (negative)
    word.remove_prefix(1);
  int base = 10;
  if (word.starts_with("0x") || word.starts_with("0X")) {
    word.remove_prefix(2);
    base = 16;
  }
  const auto value = parse_number<std::uint64_t>(word, base);
  if (!value || *value > std::uint64_t{1} << 40)
    return std::nullopt;
  const auto magnitude = static_cast<std::int64_t>(*value);
  return negative ? -magnitude : magnitude;
}

tl::expected<Bytes, EncodeError> parse_text(std::string_view text) {
  Bytes out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      out.push_back(static_cast<std::uint8_t>(text[i]));
      continue;
    }
    const auto escape = i + 1 < text.size() ? text[i + 1] : '\0';
    ++i;
    if (escape == 'n')
      out.push_back('\n');
    else if (escape == 'r')
      out.push_back('\r');
    else if (escape == 't')
      out.push_back('\t');
    else if (escape == '0')
      out.push_back(0);
    else if (escape == '\\')
      out.push_back('\\');
    else if (const auto byte = from_hex(text.substr(i + 1, 2));
             escape == 'x' && byte && byte->size() == 1) {
      out.push_back(byte->front());
      i += 2;
    } else {
      return tl::unexpected(EncodeError{
          fmt::format("`\\{}` is not an escape; write \\n, \\r, \\t, \\0, \\\\ or \\xHH",
                      escape == '\0' ? ' ' : escape)});
    }
  }
  return out;
}

tl::expected<Bytes, EncodeError> parse_hex(const Field& field, std::string_view word) {
  if (auto bytes = from_hex(word))
    return *std::move(bytes);
  return tl::unexpected(
      EncodeError{fmt::format("`{}` takes hex bytes, found `{}`", field.name, word)});
}

EncodeError out_of_range(const Field& field, std::int64_t value) {
  return {fmt::format("`{}` takes {} to {}, found {}", field.name, field.least, field.most, value)};
}

EncodeError miscounted(const spec::CommandInfo& row, std::size_t least, std::size_t most,
                       std::size_t found) {
  const auto wanted =
      least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  return {fmt::format("`{}` takes {} {}, found {}; write `{}`", row.name, wanted,
                      most == 1 ? "operand" : "operands", found, usage(row))};
}

} // namespace

std::vector<FieldValue> read_fields(std::span<const Field> fields, ByteView data) {
  std::vector<FieldValue> out;
  for (const auto& field : fields) {
    const auto size = field.type == FieldType::Data ? data.size() : spec::field_size(field.type);
    if (size > data.size())
      break;
    const auto bytes = data.first(size);
    out.push_back({&field, spec::is_number(field.type) ? read_number(field.type, bytes) : 0,
                   spec::is_number(field.type) ? ByteView{} : bytes});
    data = data.subspan(size);
  }
  return out;
}

Bytes write_fields(std::span<const Field> fields, std::span<const FieldContent> contents) {
  Bytes out;
  for (std::size_t i = 0; i < std::min(fields.size(), contents.size()); ++i) {
    const auto& [number, bytes] = contents[i];
    if (spec::is_number(fields[i].type)) {
      append_number(out, fields[i].type, number);
      continue;
    }
    const auto end = out.size() + spec::field_size(fields[i].type);
    out.insert(out.end(), bytes.begin(), bytes.end());
    if (fields[i].type != FieldType::Data)
      out.resize(end);
  }
  return out;
}

Async make_async(spec::AsyncId id, std::initializer_list<FieldContent> contents) {
  return {static_cast<std::uint8_t>(id),
          write_fields(spec::fields(id), {contents.begin(), contents.size()})};
}

tl::expected<Operands, PayloadFault> Operands::read(spec::ApiCommand command, ByteView data) {
  Operands out;
  const Field* wrong = nullptr;
  std::size_t at = 0;
  for (const auto& field : spec::operands(command)) {
    if (at == data.size() && field.presence == spec::Presence::Optional)
      break;
    if (field.type == FieldType::Data) {
      out.data_ = data.subspan(at);
      const auto size = static_cast<std::int64_t>(out.data_.size());
      if (size < field.least || size > field.most)
        return tl::unexpected(PayloadFault{});
      at = data.size();
    } else {
      const auto size = spec::field_size(field.type);
      if (data.size() - at < size)
        return tl::unexpected(PayloadFault{});
      const auto value = read_number(field.type, data.subspan(at, size));
      if (wrong == nullptr && (value < field.least || value > field.most))
        wrong = &field;
      out.numbers_[out.count_] = value;
      at += size;
    }
    ++out.count_;
  }
  if (at != data.size())
    return tl::unexpected(PayloadFault{});
  if (const auto* distance = spec::distance(command);
      distance != nullptr && wrong == nullptr &&
      out.numbers_[distance->upper] - out.numbers_[distance->lower] < distance->least)
    wrong = &spec::operands(command)[distance->lower];
  if (wrong != nullptr)
    return tl::unexpected(PayloadFault{spec::ResponseCode::BadParameter, wrong});
  return out;
}

namespace {

/// Builds the bytes of the last operand from all remaining words.
tl::expected<Bytes, EncodeError> encode_rest(const Field& field,
                                             std::span<const std::string> words) {
  const auto is_text = field.unit == "text";
  Bytes data;
  for (const auto& word : words) {
    auto bytes = is_text ? parse_text(word) : parse_hex(field, word);
    if (!bytes)
      return bytes;
    if (is_text && !data.empty())
      data.push_back(' ');
    data.insert(data.end(), bytes->begin(), bytes->end());
  }
  const auto size = static_cast<std::int64_t>(data.size());
  if (size < field.least || size > field.most) {
    const auto range = field.least == field.most ? fmt::format("{}", field.most)
                                                 : fmt::format("{} to {}", field.least, field.most);
    return tl::unexpected(
        EncodeError{fmt::format("`{}` takes {} bytes, found {}", field.name, range, size)});
  }
  return data;
}

tl::expected<std::int64_t, EncodeError> encode_number(const Field& field, const std::string& word) {
  auto value = parse_value(word);
  if (!value)
    value = named_value(field, word);
  if (!value)
    return tl::unexpected(
        EncodeError{fmt::format("`{}` takes a number, found `{}`", field.name, word)});
  if (*value < field.least || *value > field.most)
    return tl::unexpected(out_of_range(field, *value));
  return *value;
}

EncodeError too_close(const spec::Distance& distance, std::int64_t upper, std::int64_t lower) {
  const auto fields = spec::operands(distance.command);
  return {fmt::format("`{}` must be at least {} more than `{}`, found {} and {}",
                      fields[distance.upper].name, distance.least, fields[distance.lower].name,
                      upper, lower)};
}

} // namespace

tl::expected<Bytes, EncodeError> encode_operands(spec::ApiCommand command,
                                                 std::span<const std::string> words) {
  const auto& row = spec::info(command);
  const auto fields = spec::operands(command);
  const auto takes_rest = !fields.empty() && fields.back().type == FieldType::Data;
  const auto required =
      static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), [](const Field& field) {
        return field.presence == spec::Presence::Required;
      }));
  const auto may_lack = takes_rest && fields.back().least == 0 ? std::size_t{1} : 0;
  if (words.size() < required - may_lack || (words.size() > fields.size() && !takes_rest))
    return tl::unexpected(miscounted(row, required, fields.size(), words.size()));
  Bytes out;
  for (const auto& field : fields) {
    if (words.empty())
      break;
    if (field.type == FieldType::Data) {
      const auto data = encode_rest(field, words);
      if (!data)
        return data;
      out.insert(out.end(), data->begin(), data->end());
      break;
    }
    const auto value = encode_number(field, words.front());
    if (!value)
      return tl::unexpected(value.error());
    append_number(out, field.type, *value);
    words = words.subspan(1);
  }
  if (const auto* distance = spec::distance(command)) {
    const auto values = read_fields(fields, out);
    const auto upper = values[distance->upper].number;
    const auto lower = values[distance->lower].number;
    if (upper - lower < distance->least)
      return tl::unexpected(too_close(*distance, upper, lower));
  }
  return out;
}

std::string usage(const spec::CommandInfo& row) {
  std::string out(row.name);
  for (const auto& field : spec::operands(row.command)) {
    const auto word = placeholder(field);
    out += field.presence == spec::Presence::Optional ? fmt::format(" [{}]", word) : " " + word;
  }
  return out;
}

} // namespace orb::protocol
