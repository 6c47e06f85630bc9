#include "base/bytes.h"

#include <algorithm>
#include <array>

namespace orb {
namespace {

constexpr std::string_view digits = "0123456789ABCDEF";

std::optional<std::uint8_t> digit_value(char c) {
  if (c >= '0' && c <= '9')
    return static_cast<std::uint8_t>(c - '0');
  if (c >= 'a' && c <= 'f')
    return static_cast<std::uint8_t>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F')
    return static_cast<std::uint8_t>(c - 'A' + 10);
  return std::nullopt;
}

bool separates(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

} // namespace

ByteView as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string_view as_text(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void append_u16(Bytes& out, std::uint32_t value) {
  out.push_back(static_cast<std::uint8_t>(value >> 8));
  out.push_back(static_cast<std::uint8_t>(value));
}

void append_u32(Bytes& out, std::uint32_t value) {
  append_u16(out, value >> 16);
  append_u16(out, value);
}

std::string to_hex(ByteView bytes) {
  std::string out;
  out.reserve(bytes.size() * 3);
  for (const auto byte : bytes) {
    if (!out.empty())
      out += ' ';
    out += digits[byte >> 4];
    out += digits[byte & 15];
  }
  return out;
}

std::optional<Bytes> from_hex(std::string_view text) {
  Bytes out;
  for (std::size_t i = 0; i < text.size();) {
    if (separates(text[i])) {
      ++i;
      continue;
    }
    const auto rest = text.substr(i);
    if (rest.starts_with("0x") || rest.starts_with("0X")) {
      i += 2;
      continue;
    }
    if (rest.size() < 2)
      return std::nullopt;
    const auto high = digit_value(rest[0]);
    const auto low = digit_value(rest[1]);
    if (!high || !low)
      return std::nullopt;
    out.push_back(static_cast<std::uint8_t>(*high << 4 | *low));
    i += 2;
  }
  return out;
}

} // namespace orb
