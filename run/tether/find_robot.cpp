#include "protocol/decoder.h"
#include "protocol/packet.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"
#include "run/tether/run_tethered.h"
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

/// Asks until something answers.
class Question {
public:
  Question(protocol::Transport& link, Instant until) : link_(link), until_(until) {}

  /// The first answer to either of two pings.
  tl::expected<spec::Packets, Failure> packets() {
    while (link_.now() < until_) {
      for (const auto& bytes :
           {protocol::encode(protocol::make_command(spec::ApiCommand::Ping, {})),
            protocol::encode(protocol::make_request(spec::V2Command::Ping, {}, 0))}) {
        if (auto sent = link_.write(bytes); !sent)
          return tl::unexpected(lost(sent.error()));
        protocol::Decoder v1(protocol::Direction::FromBall);
        protocol::DecoderV2 v2;
        for (const auto wait = link_.now() + patience; link_.now() < wait;) {
          const auto heard = link_.read(wait);
          if (!heard)
            return tl::unexpected(lost(heard.error()));
          v1.feed(*heard);
          v2.feed(*heard);
          while (const auto item = v1.next())
            if (item->kind == protocol::Item::Kind::Response)
              return spec::Packets::V1;
          while (const auto item = v2.next())
            if (is_answer(*item))
              return spec::Packets::V2;
        }
      }
    }
    return tl::unexpected(Failure{
        ExitCode::NoBall, "no robot answers; wake it, bring it closer, or run `orb doctor`"});
  }

private:
  static constexpr Duration patience = 300ms;

  static bool is_answer(const protocol::ItemV2& item) {
    return item.kind == protocol::ItemV2::Kind::Packet &&
           spec::has(item.packet.flags, spec::V2Flag::Response);
  }

  protocol::Transport& link_;
  Instant until_;
};

/// Whether a robot that knows these commands of a device can be that one.
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

tl::expected<spec::Robot, Failure> find_robot(protocol::Transport& transport, Duration patience) {
  Question question(transport, transport.now() + patience);
  const auto packets = question.packets();
  if (!packets)
    return tl::unexpected(packets.error());
  if (*packets == spec::Packets::V1)
    return spec::Robot::Sphero;
  std::vector<const spec::RobotInfo*> left;
  for (const auto& row : spec::robots)
    if (row.packets == spec::Packets::V2)
      left.push_back(&row);
  TalkV2 talk(transport, *left.front()); // what it is asked is the same for all
  for (const auto did :
       {std::uint8_t{0x13}, std::uint8_t{0x17}, std::uint8_t{0x18}, std::uint8_t{0x1A}}) {
    const auto answer = talk.ask(spec::V2Command::GetCommandIds, {did});
    if (!answer && answer.error().code == ExitCode::Interrupted)
      return tl::unexpected(answer.error());
    if (answer && answer->error == 0)
      std::erase_if(left, [&](const auto* row) { return !fits(*row, did, answer->data); });
  }
  if (left.empty())
    return tl::unexpected(Failure{ExitCode::NoBall,
                                  "the robot speaks v2 packets, but its commands match no robot "
                                  "that orb knows; name a similar one with `--robot`"});
  if (left.size() == 1)
    return left.front()->robot;
  std::string names;
  for (const auto* row : left)
    names += fmt::format("{}`--robot {}`", names.empty() ? "" : " or ", row->name);
  return tl::unexpected(
      Failure{ExitCode::Usage,
              fmt::format("the robot speaks v2 packets but does not say which model it is; add {}",
                          names)});
}

} // namespace orb::run
