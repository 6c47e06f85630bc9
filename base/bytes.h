#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Views the bytes of a text without a copy.
ByteView as_bytes(std::string_view text);

/// Views bytes as text without a copy. The bytes need not be UTF-8.
std::string_view as_text(ByteView bytes);

/// Appends the low 16 bits of `value`, most significant byte first (API §Data Packing).
void append_u16(Bytes& out, std::uint32_t value);

/// Appends 32 bits, most significant byte first (API §Data Packing).
void append_u32(Bytes& out, std::uint32_t value);

/// Reads two bytes at `offset`, most significant first. The caller checks the size.
constexpr std::uint16_t read_u16(ByteView bytes, std::size_t offset) {
  return static_cast<std::uint16_t>(bytes[offset] << 8 | bytes[offset + 1]);
}

/// Reads four bytes at `offset`, most significant first. The caller checks the size.
constexpr std::uint32_t read_u32(ByteView bytes, std::size_t offset) {
  return static_cast<std::uint32_t>(read_u16(bytes, offset)) << 16 | read_u16(bytes, offset + 2);
}

/// Prints bytes as two-digit upper-case hex, separated by single spaces: `FF 14 00`.
std::string to_hex(ByteView bytes);

/// Reads hex digits in pairs; skips whitespace, commas and a `0x` before a pair. Returns nothing on
/// any other character or an odd digit.
std::optional<Bytes> from_hex(std::string_view text);

} // namespace orb
