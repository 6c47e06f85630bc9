#include "vm/api/profile.h"

#include "base/text/utf8.h"
#include "protocol/payload.h"

#include <algorithm>

namespace orb::vm {
namespace {

constexpr std::uint8_t config_version = 1;

/// Returns true if the command accepts this operand. A block must not bring in a value that the
/// command would refuse.
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
  const auto& color = settings.user_color;
  const protocol::FieldContent contents[] = {config_version,
                                             color.red,
                                             color.green,
                                             color.blue,
                                             settings.permanent_flags,
                                             settings.low_battery_cv,
                                             settings.critical_battery_cv,
                                             settings.inactivity_timeout / std::chrono::seconds{1},
                                             profile.auto_reconnect,
                                             profile.auto_reconnect_s,
                                             as_bytes(profile.name)};
  auto out = protocol::write_fields(spec::config_fields(), contents);
  out.resize(spec::config_block_size);
  return out;
}

bool load_config_block(ByteView block, Settings& settings, Profile& profile) {
  using spec::ApiCommand;
  namespace at = spec::config_at;
  if (block.size() != spec::config_block_size)
    return false;
  const auto fields = protocol::read_fields(spec::config_fields(), block);
  const auto number = [&](std::size_t field) { return fields[field].number; };
  const auto byte = [&](std::size_t field) { return static_cast<std::uint8_t>(number(field)); };
  if (byte(at::Version) != config_version ||
      !in_range(ApiCommand::SetVoltageTripPoints, 0, number(at::LowBattery)) ||
      !in_range(ApiCommand::SetVoltageTripPoints, 1, number(at::CriticalBattery)) ||
      !in_range(ApiCommand::SetInactivityTimeout, 0, number(at::InactivityTimeout)) ||
      !in_range(ApiCommand::SetAutoReconnect, 0, number(at::AutoReconnect)) ||
      number(at::LowBattery) - number(at::CriticalBattery) <
          spec::distance(ApiCommand::SetVoltageTripPoints)->least)
    return false;
  settings.user_color = {byte(at::Red), byte(at::Green), byte(at::Blue)};
  settings.permanent_flags = static_cast<std::uint32_t>(number(at::PermanentFlags));
  settings.low_battery_cv = static_cast<int>(number(at::LowBattery));
  settings.critical_battery_cv = static_cast<int>(number(at::CriticalBattery));
  settings.inactivity_timeout = std::chrono::seconds{number(at::InactivityTimeout)};
  profile.auto_reconnect = byte(at::AutoReconnect) != 0;
  profile.auto_reconnect_s = byte(at::AutoReconnectTime);
  const auto name = as_text(fields[at::Name].bytes.first(spec::ball::name_size));
  profile.name = clip_utf8(name.substr(0, name.find('\0')), spec::ball::name_size);
  return true;
}

} // namespace orb::vm
