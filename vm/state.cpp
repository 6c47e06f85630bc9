#include "vm/state.h"

#include "base/hash.h"
#include "base/text/text.h"
#include "protocol/payload.h"
#include "vm/ball.h"

#include <fmt/format.h>
#include <map>

namespace orb::vm {
namespace {

constexpr std::string_view kind = "orb.state/";
constexpr int version = 2; ///< version 2 added the checksum

std::string checksum(std::string_view text) {
  return fmt::format("{:016X}", hash(text));
}

Bytes life(const Profile& profile, std::uint64_t rolled_cm) {
  const protocol::FieldContent contents[] = {profile.charges,  profile.cold_boots,
                                             profile.wake_ups, profile.since_charge_s,
                                             profile.awake_s,  rolled_cm};
  return protocol::write_fields(spec::life_fields(), contents);
}

void load_life(ByteView bytes, Profile& profile) {
  namespace at = spec::life_at;
  const auto fields = protocol::read_fields(spec::life_fields(), bytes);
  const auto number = [&](std::size_t field) { return fields[field].number; };
  profile.charges = static_cast<std::uint16_t>(number(at::Charges));
  profile.cold_boots = static_cast<std::uint16_t>(number(at::ColdBoots) + 1); // this start counts
  profile.wake_ups = static_cast<std::uint16_t>(number(at::WakeUps));
  profile.since_charge_s = static_cast<std::uint64_t>(number(at::SinceCharge));
  profile.awake_s = static_cast<std::uint64_t>(number(at::Awake));
  profile.rolled_cm = static_cast<std::uint64_t>(number(at::Rolled));
}

} // namespace

std::string save_state(Ball& ball) {
  const auto& profile = ball.profile();
  auto out = fmt::format("{}{}\n", kind, version);
  const auto line = [&](std::string_view word, ByteView bytes) {
    out += fmt::format("{} {}\n", word, to_hex(bytes));
  };
  line("config", config_block(ball.settings(), profile));
  line("soul", profile.soul.block());
  line("life", life(profile, profile.rolled_cm + ball.body().rolled_cm()));
  line("flash", as_bytes(ball.basic_text(Area::Flash)));
  return out + fmt::format("sum {}\nend\n", checksum(out));
}

namespace {

/// Removes the first line of a text and returns it.
std::string_view take_line(std::string_view& text) {
  const auto line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

/// Parses the version in the first line of the file.
tl::expected<int, std::string> read_version(std::string_view line) {
  const auto number =
      line.starts_with(kind) ? parse_number<int>(line.substr(kind.size())) : std::optional<int>();
  if (!number || *number < 1)
    return tl::unexpected(fmt::format("it does not begin with `{}{}`", kind, version));
  if (*number > version)
    return tl::unexpected(
        fmt::format("it is version {}; this orb reads 1 to {}", *number, version));
  return *number;
}

} // namespace

tl::expected<void, std::string> load_state(std::string_view text, Ball& ball) {
  const auto whole = text;
  const auto found = read_version(take_line(text));
  if (!found)
    return tl::unexpected(found.error());
  std::map<std::string_view, Bytes> fields;
  bool ended = false;
  bool summed = false;
  while (!text.empty() && !ended) {
    const auto before = whole.substr(0, whole.size() - text.size());
    const auto line = take_line(text);
    const auto blank = std::min(line.find(' '), line.size());
    const auto word = line.substr(0, blank);
    const auto rest = line.substr(std::min(blank + 1, line.size()));
    ended = word == "end";
    if (word == "sum") {
      summed = rest == checksum(before);
      continue;
    }
    const auto bytes = from_hex(rest);
    if (!bytes)
      return tl::unexpected(fmt::format("`{}` is not followed by hex bytes", word));
    fields.insert_or_assign(word, *bytes);
  }
  if (!ended)
    return tl::unexpected(std::string("its last line is not `end`"));
  if (*found >= 2 && !summed)
    return tl::unexpected(std::string("its checksum is wrong, so it is damaged"));
  Settings settings;
  Profile profile;
  if (!load_config_block(fields["config"], settings, profile))
    return tl::unexpected(std::string("`config` is not a configuration block"));
  if (!profile.soul.load(fields["soul"]))
    return tl::unexpected(std::string("`soul` is not a soul block"));
  if (const auto size = life({}, 0).size(); fields["life"].size() != size)
    return tl::unexpected(fmt::format("`life` must be {} bytes", size));
  load_life(fields["life"], profile);
  if (ball.erase_basic(Area::Flash) == Outcome::Refused ||
      ball.append_basic(Area::Flash, fields["flash"]) == Outcome::Refused)
    return tl::unexpected(std::string("`flash` is larger than the flash area"));
  ball.restore(settings, profile);
  return {};
}

} // namespace orb::vm
