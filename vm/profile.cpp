#include "vm/profile.h"

#include "base/utf8.h"
#include "spec/api.h"

#include <algorithm>

namespace orb::vm {
namespace {

constexpr std::uint8_t block_version = 1;
constexpr std::size_t name_at = 16;

/// The range of an operand, so that a block cannot bring in what a command would refuse.
bool in_range(spec::ApiCommand command, std::size_t operand, std::int64_t value) {
  const auto& field = spec::operands(command)[operand];
  return value >= field.least && value <= field.most;
}

} // namespace

std::string_view clip_utf8(std::string_view text, std::size_t most) {
  std::size_t size = 0;
  while (size < text.size()) {
    const auto next = std::max<std::size_t>(1, utf8_length(text.substr(size)));
    if (size + next > most)
      break;
    size += next;
  }
  return text.substr(0, size);
}

Bytes config_block(const Settings& settings, const Profile& profile) {
  Bytes out{block_version, settings.user_color.red, settings.user_color.green,
            settings.user_color.blue};
  append_u32(out, settings.permanent_flags);
  append_u16(out, static_cast<std::uint32_t>(settings.low_battery_cv));
  append_u16(out, static_cast<std::uint32_t>(settings.critical_battery_cv));
  append_u16(out,
             static_cast<std::uint32_t>(settings.inactivity_timeout / std::chrono::seconds{1}));
  out.push_back(profile.auto_reconnect ? 1 : 0);
  out.push_back(profile.auto_reconnect_s);
  out.insert(out.end(), profile.name.begin(), profile.name.end());
  out.resize(spec::config_block_size);
  return out;
}

bool load_config_block(ByteView block, Settings& settings, Profile& profile) {
  using spec::ApiCommand;
  if (block.size() != spec::config_block_size || block[0] != block_version)
    return false;
  const auto low = read_u16(block, 8);
  const auto critical = read_u16(block, 10);
  const auto timeout = read_u16(block, 12);
  if (!in_range(ApiCommand::SetVoltageTripPoints, 0, low) ||
      !in_range(ApiCommand::SetVoltageTripPoints, 1, critical) ||
      !in_range(ApiCommand::SetInactivityTimeout, 0, timeout) ||
      !in_range(ApiCommand::SetAutoReconnect, 0, block[14]) ||
      low - critical < trip_point_distance_cv)
    return false;
  settings.user_color = {block[1], block[2], block[3]};
  settings.permanent_flags = read_u32(block, 4);
  settings.low_battery_cv = low;
  settings.critical_battery_cv = critical;
  settings.inactivity_timeout = std::chrono::seconds{timeout};
  profile.auto_reconnect = block[14] != 0;
  profile.auto_reconnect_s = block[15];
  const auto name = as_text(block.subspan(name_at, name_size));
  profile.name = clip_utf8(name.substr(0, name.find('\0')), name_size);
  return true;
}

} // namespace orb::vm
