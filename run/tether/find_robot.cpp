#include "run/tether/find_robot.h"

#include "protocol/packet.h"
#include "protocol/payload.h"
#include "run/tether/hail.h"
#include "run/tether/talk_v2.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::run {
namespace {

using protocol::LinkError;

Failure lost(const LinkError& error) {
  if (error.kind == LinkError::Kind::Interrupted)
    return {ExitCode::Interrupted, "interrupted; the robot is unchanged"};
  return {ExitCode::NoBall, error.message};
}

/// Returns true if the commands listed for a device are those of this robot.
bool fits(const spec::RobotInfo& robot, std::uint8_t did, const Bytes& commands) {
  return std::all_of(spec::v2_commands.begin(), spec::v2_commands.end(),
                     [&](const spec::V2CommandInfo& row) {
                       const bool listed =
                           std::find(commands.begin(), commands.end(), row.cid()) != commands.end();
                       return row.did() != did || row.robots == spec::v2_set::All ||
                              listed == spec::knows(robot, row);
                     });
}

} // namespace

tl::expected<spec::Packets, Failure> find_packets(protocol::Transport& transport,
                                                  Duration patience) {
  constexpr Duration between_pings = 600ms;
  Hail hail(transport);
  const auto ping = protocol::encode(protocol::make_command(spec::ApiCommand::Ping, {}));
  for (const auto until = hail.now() + patience; hail.now() < until;) {
    const auto wait = hail.now() + between_pings;
    auto asked = hail.write(ping);
    while (asked && !hail.answered() && hail.now() < wait)
      if (const auto heard = hail.read(wait); !heard)
        asked = tl::unexpected(heard.error());
    if (hail.answered())
      return *hail.answered();
    if (!asked)
      return tl::unexpected(lost(asked.error()));
  }
  return tl::unexpected(
      Failure{ExitCode::NoBall, "no robot answers; wake it, bring it closer, or run `orb doctor`"});
}

tl::expected<spec::Robot, Failure> find_robot(protocol::Transport& transport, Duration patience) {
  const auto packets = find_packets(transport, patience);
  if (!packets)
    return tl::unexpected(packets.error());
  return *packets == spec::Packets::V1 ? spec::Robot::Sphero : find_newer_robot(transport);
}

tl::expected<std::vector<spec::Robot>, Failure> fitting_robots(protocol::Transport& transport) {
  std::vector<spec::Robot> left;
  for (const auto& row : spec::robots)
    if (row.packets == spec::Packets::V2)
      left.push_back(row.robot);
  int answers = 0;
  TalkV2 talk(transport, spec::info(left.front())); // the questions are the same for all robots
  for (const auto did :
       {std::uint8_t{0x13}, std::uint8_t{0x17}, std::uint8_t{0x18}, std::uint8_t{0x1A}}) {
    const auto answer = talk.ask(spec::V2Command::GetCommandIds, {did});
    if (!answer && answer.error().code == ExitCode::Interrupted)
      return tl::unexpected(answer.error());
    answers += answer ? 1 : 0;
    if (!answer && answers == 0)
      return tl::unexpected(Failure{ExitCode::NoBall, answer.error().message});
    if (answer && answer->error == 0)
      std::erase_if(left, [&](auto robot) { return !fits(spec::info(robot), did, answer->data); });
  }
  if (left.empty())
    return tl::unexpected(Failure{ExitCode::NoBall,
                                  "the robot speaks v2 packets, but its commands match no robot "
                                  "that orb knows; name a similar one with `--robot`"});
  return left;
}

tl::expected<spec::Robot, Failure> only_one(const std::vector<spec::Robot>& robots) {
  if (robots.size() == 1)
    return robots.front();
  std::string names;
  for (const auto robot : robots)
    names += fmt::format("{}`--robot {}`", names.empty() ? "" : " or ", spec::info(robot).name);
  return tl::unexpected(
      Failure{ExitCode::Usage,
              fmt::format("the robot speaks v2 packets but does not say which model it is; add {}",
                          names)});
}

tl::expected<spec::Robot, Failure> find_newer_robot(protocol::Transport& transport) {
  const auto fitting = fitting_robots(transport);
  return fitting ? only_one(*fitting) : tl::unexpected(fitting.error());
}

} // namespace orb::run
