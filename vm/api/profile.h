#pragma once

#include "base/bytes.h"
#include "vm/api/soul.h"
#include "vm/common/settings.h"

#include <cstdint>
#include <optional>
#include <string>

namespace orb::vm {

/// What a ball keeps across power cycles besides its Settings: name, lifetime counters, soul block.
struct Profile {
  std::string name; ///< at most spec::ball::name_size bytes, whole UTF-8 characters; empty: the
                    ///< default name
  bool auto_reconnect = true;
  std::uint8_t auto_reconnect_s = 0;
  Soul soul;

  // Lifetime counters. Source: API §Perform Level 2 Diagnostics.
  std::uint16_t charges = 0;
  std::uint64_t since_charge_s = 0; ///< time awake
  std::uint64_t awake_s = 0;
  std::uint64_t rolled_cm = 0;
  std::uint16_t cold_boots = 0;
  std::uint16_t wake_ups = 0;
};

/// Returns the longest prefix of `text` that has at most `most` bytes and does not split a UTF-8
/// character.
std::string_view clip_utf8(std::string_view text, std::size_t most);

/// Returns the user configuration block: spec::config_block_size bytes in our own layout [?]
/// (docs/reference/protocol.md).
Bytes config_block(const Settings& settings, const Profile& profile);
/// Loads a block made by config_block(). Returns false and changes nothing for any other block.
bool load_config_block(ByteView block, Settings& settings, Profile& profile);

} // namespace orb::vm
