#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The packet format of the newer robots. Source: PKT.
namespace orb::spec {

inline constexpr std::uint8_t v2_start = 0x8D;
inline constexpr std::uint8_t v2_end = 0xD8;
inline constexpr std::uint8_t v2_escape = 0xAB;
/// A reserved byte is sent as the escape byte followed by the byte with these bits cleared.
inline constexpr std::uint8_t v2_escape_bits = 0x88;

/// Packets with more bytes between start and end are treated as noise [?].
inline constexpr std::size_t v2_max_packet = 4096;

enum class V2Flag : std::uint8_t {
#define V2_FLAG(enumerator, bit, name, meaning) enumerator = 1 << (bit),
#include "spec/packet_v2.def"
};

struct V2FlagInfo {
  V2Flag flag;
  std::string_view name;
  std::string_view meaning;
};

inline constexpr auto v2_flags = std::to_array<V2FlagInfo>({
#define V2_FLAG(enumerator, bit, name, meaning) {V2Flag::enumerator, name, meaning},
#include "spec/packet_v2.def"
});

constexpr bool has(std::uint8_t flags, V2Flag flag) {
  return (flags & static_cast<std::uint8_t>(flag)) != 0;
}

enum class V2Error : std::uint8_t {
#define V2_ERROR(enumerator, code, meaning) enumerator = code,
#include "spec/packet_v2.def"
};

struct V2ErrorInfo {
  V2Error code;
  std::string_view meaning;
};

inline constexpr auto v2_errors = std::to_array<V2ErrorInfo>({
#define V2_ERROR(enumerator, code, meaning) {V2Error::enumerator, meaning},
#include "spec/packet_v2.def"
});

/// Finds the row of an error code; null if no document names it.
constexpr const V2ErrorInfo* find_v2_error(std::uint8_t code) {
  for (const auto& row : v2_errors)
    if (row.code == static_cast<V2Error>(code))
      return &row;
  return nullptr;
}

static_assert(
    [] {
      for (std::size_t i = 0; i < v2_errors.size(); ++i)
        if (static_cast<std::size_t>(v2_errors[i].code) != i)
          return false;
      return true;
    }(),
    "v2 error codes count up from 0");

} // namespace orb::spec
