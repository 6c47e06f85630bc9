#include "run/tether/hail.h"

#include "protocol/payload_v2.h"

#include <algorithm>

namespace orb::run {
namespace {

using protocol::LinkError;

constexpr Duration before_ping = 300ms; ///< a classic ball answers within 100 ms
constexpr Duration between_pings = 1s;

LinkError spoken_otherwise() {
  return {LinkError::Kind::Unfit, "the robot speaks v2 packets"};
}

} // namespace

tl::expected<void, LinkError> Hail::write(ByteView bytes) {
  if (answered_ == spec::Packets::V2)
    return tl::unexpected(spoken_otherwise());
  if (!answered_ && ping_at_ == never)
    ping_at_ = now() + before_ping;
  return link_.write(bytes);
}

tl::expected<Bytes, LinkError> Hail::read(Instant deadline) {
  while (!answered_) {
    auto heard = link_.read(std::min(deadline, ping_at_));
    if (!heard)
      return heard;
    hear(*heard);
    if (answered_ == spec::Packets::V2)
      break;
    if (now() >= ping_at_)
      if (auto sent = ping(); !sent)
        return tl::unexpected(sent.error());
    if (!heard->empty() || now() >= deadline || deadline == never)
      return heard;
  }
  if (answered_ == spec::Packets::V2)
    return tl::unexpected(spoken_otherwise());
  return link_.read(deadline);
}

tl::expected<void, LinkError> Hail::ping() {
  ping_at_ = now() + between_pings;
  return link_.write(protocol::encode(protocol::make_request(spec::V2Command::Ping, {}, 0)));
}

void Hail::hear(ByteView bytes) {
  v1_.feed(bytes);
  v2_.feed(bytes);
  while (const auto item = v1_.next())
    if (item->kind == protocol::Item::Kind::Response)
      answered_ = spec::Packets::V1;
  while (const auto item = v2_.next()) {
    if (item->kind != protocol::ItemV2::Kind::Packet)
      continue;
    const bool is_answer = spec::has(item->packet.flags, spec::V2Flag::Response);
    if (!answered_ && is_answer)
      answered_ = spec::Packets::V2;
    echoes_ = echoes_ || (!is_answer && item->packet.seq != spec::v2_message_seq);
  }
}

} // namespace orb::run
