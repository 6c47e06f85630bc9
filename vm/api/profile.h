#pragma once

#include "base/bytes.h"
#include "vm/api/soul.h"
#include "vm/settings.h"

#include <cstdint>
#include <optional>
#include <string>

namespace orb::vm {

/// What a ball remembers across power cycles besides its Settings: names, counters of its life, the
/// soul block.
struct Profile {
  std::string
      name; ///< at most spec::ball::name_size bytes, whole UTF-8 characters; empty: the default
  bool auto_reconnect = true;
  std::uint8_t auto_reconnect_s = 0;
  Soul soul;

  // Of its life. Source: API §Perform Level 2 Diagnostics.
  std::uint16_t charges = 0;
  std::uint64_t since_charge_s = 0; ///< awake
  std::uint64_t awake_s = 0;
  std::uint64_t rolled_cm = 0;
  std::uint16_t cold_boots = 0;
  std::uint16_t wake_ups = 0;
};

/// The front of `text` of at most `most` bytes that ends with a whole UTF-8 character.
std::string_view clip_utf8(std::string_view text, std::size_t most);

/// The user configuration block: spec::config_block_size bytes, whose layout is ours [?]
/// (docs/protocol.md).
Bytes config_block(const Settings& settings, const Profile& profile);
/// Takes over a block as config_block() makes them; false, and nothing changed, for others.
bool load_config_block(ByteView block, Settings& settings, Profile& profile);

} // namespace orb::vm
