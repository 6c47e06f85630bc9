#include "run/tether/talk_v2.h"

#include "protocol/payload_v2.h"

#include <fmt/format.h>

namespace orb::run {
namespace {

bool has_message(const protocol::PacketV2& packet, spec::V2Message message) {
  return packet.seq == spec::v2_message_seq &&
         (packet.did << 8 | packet.cid) == static_cast<int>(message);
}

} // namespace

tl::expected<protocol::PacketV2, Failure> TalkV2::ask(spec::V2Command command, Bytes data) {
  constexpr int attempts = 3;
  constexpr Duration patience = 700ms;
  const auto bytes =
      encode(protocol::address(protocol::make_request(command, std::move(data), seq_), robot_));
  protocol::DecoderV2 decoder;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    auto sent = link_.write(bytes);
    for (const auto until = link_.now() + patience; sent && link_.now() < until;) {
      auto heard = link_.read(until);
      if (!heard) {
        sent = tl::unexpected(heard.error());
        break;
      }
      decoder.feed(*heard);
      while (auto item = decoder.next()) {
        if (item->kind != protocol::ItemV2::Kind::Packet)
          continue;
        asleep_ = has_message(item->packet, spec::V2Message::DidSleep);
        const auto& row = spec::info(command);
        // A late answer to another request may have the same number.
        if (item->packet.seq == seq_ && item->packet.did == row.did() &&
            item->packet.cid == row.cid() &&
            spec::has(item->packet.flags, spec::V2Flag::Response)) {
          seq_ = seq_ >= spec::v2_last_seq ? 0 : static_cast<std::uint8_t>(seq_ + 1);
          return std::move(item->packet);
        }
      }
    }
    if (!sent && sent.error().kind == protocol::LinkError::Kind::Interrupted)
      return tl::unexpected(Failure{ExitCode::Interrupted, "interrupted"});
    if (!sent)
      return tl::unexpected(Failure{ExitCode::LinkLost, sent.error().message});
  }
  return tl::unexpected(silent(command));
}

Failure TalkV2::silent(spec::V2Command command) const {
  const auto name = spec::info(command).name;
  if (asleep_)
    return {
        ExitCode::LinkLost,
        fmt::format("the robot has gone to sleep and does not answer {}; run the command again, "
                    "which wakes it, or put it on its charger for a moment (an RVR: press its "
                    "power button)",
                    name)};
  return {ExitCode::LinkLost,
          fmt::format("the robot does not answer {}; wake it, bring it closer, or run `orb doctor`",
                      name)};
}

tl::expected<protocol::PacketV2, Failure> TalkV2::request(spec::V2Command command, Bytes data) {
  auto answer = ask(command, std::move(data));
  if (!answer || answer->error == 0)
    return answer;
  const auto* row = spec::find_v2_error(answer->error);
  return tl::unexpected(Failure{
      ExitCode::Refused, fmt::format("the robot refuses {}: {:02X}h {}", spec::info(command).name,
                                     answer->error, row == nullptr ? "unknown" : row->meaning)});
}

} // namespace orb::run
