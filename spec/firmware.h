#pragma once

#include "spec/api.h"
#include "spec/basic.h"
#include "spec/limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// The firmware of a simulated ball. Source: SEMANTICS of versions in docs/reference/protocol.md.
namespace orb::spec {

enum class Firmware : std::uint8_t {
#define FIRMWARE(enumerator, ...) enumerator,
#include "spec/firmware.def"
};

/// The offsets in the version record. Early records end before the API revision.
inline constexpr auto version_model_at = answer_offset(ApiCommand::GetVersioning, "model");
inline constexpr auto version_firmware_at =
    answer_offset(ApiCommand::GetVersioning, "firmware version");
inline constexpr auto version_orbbasic_at = answer_offset(ApiCommand::GetVersioning, "orbBasic");
inline constexpr auto version_macro_at =
    answer_offset(ApiCommand::GetVersioning, "macro executive");
inline constexpr auto version_api_at = answer_offset(ApiCommand::GetVersioning, "api major");
inline constexpr auto version_record_max =
    answer_offset(ApiCommand::GetVersioning, "api minor") + 1;

/// The size of the orbBasic RAM area by API revision, in bytes, including the final NUL.
constexpr std::uint16_t ram_bytes_of(Revision api) {
  struct Row {
    Revision since;
    Limit limit;
  };
  constexpr auto rows = std::to_array<Row>({
#define ORBBASIC_RAM(major, minor, limit) {{major, minor}, Limit::limit},
#include "spec/firmware.def"
  });
  for (const auto& row : rows)
    if (api >= row.since)
      return static_cast<std::uint16_t>(value_of(row.limit));
  return 0;
}

/// An orbBasic version (packed nibbles) and the API of the same date.
struct BasicAge {
  std::uint8_t orbbasic;
  Revision api;
};

inline constexpr auto basic_ages = std::to_array<BasicAge>({
#define ORBBASIC_API(version, major, minor) {version, {major, minor}},
#include "spec/firmware.def"
});

/// The API revision for a record of 8 bytes, inferred from its orbBasic; 0.0 if unknown.
constexpr Revision api_of(std::uint8_t orbbasic) {
  for (const auto& row : basic_ages)
    if (orbbasic >= row.orbbasic)
      return row.api;
  return {};
}

/// The language of a ball that reports this orbBasic (packed nibbles) and this API: the newer of
/// the two. A version without a row adds nothing to the one before.
constexpr BasicVersion language_of(std::uint8_t orbbasic, Revision api) {
  for (const auto& row : basic_ages)
    if (api >= row.api && orbbasic < row.orbbasic)
      orbbasic = row.orbbasic;
  const auto nibbles = [](std::string_view text) { // `1.6`
    return (text.front() - '0') << 4 | (text.back() - '0');
  };
  auto language = basic_versions.front().version;
  for (const auto& row : basic_versions)
    if (orbbasic >= nibbles(row.text))
      language = row.version;
  return language;
}

/// Where a model stores its firmware.
struct FlashPages {
  std::uint8_t model;
  int first;
  int count;
  int bytes; ///< per page

  constexpr bool has(int page) const { return page >= first && page < first + count; }
};

inline constexpr auto flash_pages = std::to_array<FlashPages>({
#define FLASH_PAGES(model, first, count, bytes) {model, first, count, bytes},
#include "spec/firmware.def"
});

/// How the firmware answers the packet counts of Level 2 Diagnostics.
enum class Level2 : std::uint8_t {
  Supported,
  Refused, ///< 04h, as for an unknown command
};

/// The effect of a value out of range on a program.
enum class Ranges : std::uint8_t {
  Documented, ///< stops it
  Lenient,    ///< colours are clamped and negative headings wrapped; others stop it
};

struct FirmwareInfo {
  Firmware firmware;
  std::string_view name; ///< as for `--firmware`
  std::array<std::uint8_t, version_record_max> record_bytes;
  std::uint8_t record_size; ///< 8 or 10
  Revision api;
  Level2 level_2;
  Ranges ranges;
  std::string_view summary;

  /// The answer to Get Versioning.
  constexpr std::span<const std::uint8_t> record() const {
    return std::span(record_bytes).first(record_size);
  }
  /// The orbBasic version in packed nibbles: 16h is 1.6; 0 without orbBasic.
  constexpr std::uint8_t orbbasic() const { return record_bytes[version_orbbasic_at]; }
  constexpr bool has_orbbasic() const { return orbbasic() != 0; }
  /// The language of its programs, if it has orbBasic.
  constexpr BasicVersion language() const { return language_of(orbbasic(), api); }
  /// The version of the macro executive, as in spec/macro.def.
  constexpr std::uint8_t macro_executive() const { return record_bytes[version_macro_at]; }
  /// True if the bootloader has a firmware to start.
  constexpr bool has_firmware() const {
    return record_bytes[version_firmware_at] != 0 || record_bytes[version_firmware_at + 1] != 0;
  }
  /// The size of the orbBasic RAM area, including the final NUL; 0 without orbBasic.
  constexpr std::uint16_t ram_bytes() const {
    return has_orbbasic() ? ram_bytes_of(api) : std::uint16_t{0};
  }

  /// True if bit 1 of SOP2 decides whether a command resets the inactivity timer; earlier, every
  /// command did. Since firmware 1.26 (API §Client Command Packets).
  constexpr bool has_option_bits() const {
    constexpr Revision first{1, 26};
    return Revision{record_bytes[version_firmware_at], record_bytes[version_firmware_at + 1]} >=
           first;
  }

  /// True if this firmware has the command. Depends on the API revision; commands of orbBasic also
  /// need orbBasic.
  constexpr bool knows(const CommandInfo& command) const {
    return command.since <= api && (has_orbbasic() || !is_orbbasic(command.command)) &&
           (level_2 == Level2::Supported ||
            command.command != ApiCommand::PerformLevel2Diagnostics);
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
#define FIRMWARE(enumerator, name, record, major, minor, level_2, ranges, summary)                 \
  {Firmware::enumerator, name,           record.bytes, record.size, {major, minor},                \
   Level2::level_2,      Ranges::ranges, summary},
#include "spec/firmware.def"
#undef VERSIONS
});

inline constexpr Firmware default_firmware = firmwares.front().firmware;

constexpr const FirmwareInfo& info(Firmware firmware) {
  return firmwares[static_cast<std::size_t>(firmware)];
}

/// Finds where a model stores its firmware; null if no source says.
constexpr const FlashPages* find_flash_pages(std::uint8_t model) {
  for (const auto& row : flash_pages)
    if (row.model == model)
      return &row;
  return nullptr;
}

/// Finds a firmware by a name such as `bb-8`; null if there is none.
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
