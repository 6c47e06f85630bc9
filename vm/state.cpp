#include "vm/state.h"

#include "vm/ball.h"

#include <fmt/format.h>
#include <map>

namespace orb::vm {
namespace {

constexpr std::string_view header = "orb.state/1";

Bytes life(const Profile& profile, const Body& body) {
  Bytes out;
  append_u16(out, profile.charges);
  append_u16(out, profile.cold_boots);
  append_u16(out, profile.wake_ups);
  for (const auto value :
       {profile.since_charge_s, profile.awake_s, profile.rolled_cm + body.rolled_cm()}) {
    append_u32(out, static_cast<std::uint32_t>(value >> 32));
    append_u32(out, static_cast<std::uint32_t>(value));
  }
  return out;
}

constexpr std::size_t life_size = 3 * 2 + 3 * 8;

std::uint64_t read_u64(ByteView bytes, std::size_t offset) {
  return std::uint64_t{read_u32(bytes, offset)} << 32 | read_u32(bytes, offset + 4);
}

void load_life(ByteView bytes, Profile& profile) {
  profile.charges = read_u16(bytes, 0);
  profile.cold_boots = static_cast<std::uint16_t>(read_u16(bytes, 2) + 1); // this start counts
  profile.wake_ups = read_u16(bytes, 4);
  profile.since_charge_s = read_u64(bytes, 6);
  profile.awake_s = read_u64(bytes, 14);
  profile.rolled_cm = read_u64(bytes, 22);
}

} // namespace

std::string save_state(Ball& ball) {
  const auto& profile = ball.profile();
  std::string out(header);
  out += '\n';
  const auto line = [&](std::string_view word, ByteView bytes) {
    out += fmt::format("{} {}\n", word, to_hex(bytes));
  };
  line("config", config_block(ball.settings(), profile));
  line("soul", profile.soul.block());
  line("life", life(profile, ball.body()));
  line("flash", as_bytes(ball.basic_text(Area::Flash)));
  out += "end\n";
  return out;
}

tl::expected<void, std::string> load_state(std::string_view text, Ball& ball) {
  std::map<std::string_view, Bytes> fields;
  bool headed = false;
  bool ended = false;
  while (!text.empty() && !ended) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (!headed) {
      headed = line == header;
      if (!headed)
        return tl::unexpected(fmt::format("it does not begin with `{}`", header));
      continue;
    }
    const auto blank = std::min(line.find(' '), line.size());
    const auto word = line.substr(0, blank);
    ended = word == "end";
    const auto bytes = from_hex(line.substr(std::min(blank + 1, line.size())));
    if (!bytes)
      return tl::unexpected(fmt::format("`{}` is not followed by hex bytes", word));
    fields.insert_or_assign(word, *bytes);
  }
  if (!ended)
    return tl::unexpected(std::string("its last line is not `end`"));
  Settings settings;
  Profile profile;
  if (!load_config_block(fields["config"], settings, profile))
    return tl::unexpected(std::string("`config` is not a configuration block"));
  if (!profile.soul.load(fields["soul"]))
    return tl::unexpected(std::string("`soul` is not a soul block"));
  if (fields["life"].size() != life_size)
    return tl::unexpected(fmt::format("`life` is {} bytes", life_size));
  load_life(fields["life"], profile);
  if (ball.erase_basic(Area::Flash) == Outcome::Refused ||
      ball.append_basic(Area::Flash, fields["flash"]) == Outcome::Refused)
    return tl::unexpected(std::string("`flash` is larger than the flash area"));
  ball.restore(settings, profile);
  return {};
}

} // namespace orb::vm
