#pragma once

#include "spec/api.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// Which firmware a simulated ball runs. Source: SEMANTICS of versions in docs/protocol.md.
namespace orb::spec {

enum class Firmware : std::uint8_t {
#define FIRMWARE(enumerator, name, ram, record, major, minor, summary) enumerator,
#include "spec/firmware.def"
#undef FIRMWARE
};

/// The places of the version record. Source: API §Get Versioning.
inline constexpr std::size_t version_record_max = 10;
inline constexpr std::size_t version_orbbasic_at = 6;
inline constexpr std::size_t version_macro_at = 7;

struct FirmwareInfo {
  Firmware firmware;
  std::string_view name;   ///< as `--firmware` takes it
  std::uint16_t ram_bytes; ///< of the orbBasic RAM area, the final NUL included; 0 without orbBasic
  std::array<std::uint8_t, version_record_max> record_bytes;
  std::uint8_t record_size; ///< 8 or 10
  std::uint8_t api_major;
  std::uint8_t api_minor;
  std::string_view summary;

  /// The answer of Get Versioning.
  constexpr std::span<const std::uint8_t> record() const {
    return std::span(record_bytes).first(record_size);
  }
  /// The orbBasic version in packed nibbles: 16h is 1.6; 0 where there is none.
  constexpr std::uint8_t orbbasic() const { return record_bytes[version_orbbasic_at]; }
  constexpr bool has_orbbasic() const { return orbbasic() != 0; }

  /// Whether bit 1 of SOP2 decides if a command resets the inactivity timer; earlier every one did.
  /// Since firmware 1.26 (API §Client Command Packets).
  constexpr bool has_option_bits() const {
    constexpr std::size_t version_at = 3; // MSA-ver, MSA-rev
    return record_bytes[version_at] > 1 ||
           (record_bytes[version_at] == 1 && record_bytes[version_at + 1] >= 26);
  }

  /// Whether this firmware has the command: by the API revision, and orbBasic's only with orbBasic.
  constexpr bool knows(const CommandInfo& command) const {
    const auto newer = command.since_major > api_major ||
                       (command.since_major == api_major && command.since_minor > api_minor);
    return !newer && (has_orbbasic() || !is_orbbasic(command.command));
  }
};

namespace detail {

struct VersionRecord {
  std::array<std::uint8_t, version_record_max> bytes{};
  std::uint8_t size = 0;
};

template <class... Byte>
constexpr VersionRecord version_record(Byte... bytes) {
  return {{static_cast<std::uint8_t>(bytes)...}, sizeof...(bytes)};
}

} // namespace detail

inline constexpr auto firmwares = std::to_array<FirmwareInfo>({
#define VERSIONS(...) detail::version_record(__VA_ARGS__)
#define FIRMWARE(enumerator, name, ram, record, major, minor, summary)                             \
  {Firmware::enumerator, name, ram, record.bytes, record.size, major, minor, summary},
#include "spec/firmware.def"
#undef FIRMWARE
#undef VERSIONS
});

inline constexpr Firmware default_firmware = firmwares.front().firmware;

constexpr const FirmwareInfo& info(Firmware firmware) {
  return firmwares[static_cast<std::size_t>(firmware)];
}

/// The row of a name such as `bb-8`; null when there is none.
constexpr const FirmwareInfo* find_firmware(std::string_view name) {
  for (const auto& row : firmwares)
    if (row.name == name)
      return &row;
  return nullptr;
}

static_assert(
    [] {
      for (std::size_t i = 0; i < firmwares.size(); ++i)
        if (static_cast<std::size_t>(firmwares[i].firmware) != i ||
            find_firmware(firmwares[i].name) != &firmwares[i])
          return false;
      return true;
    }(),
    "firmware rows stand in the order of their enumerators and have unique names");

} // namespace orb::spec
