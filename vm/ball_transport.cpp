#include "vm/ball_transport.h"

#include <algorithm>

namespace orb::vm {

BallTransport::BallTransport(Ball& ball, const WireModel& wire) : ball_(ball), wire_(wire) {
  ball_.connect();
}

BallTransport::~BallTransport() {
  ball_.disconnect();
}

tl::expected<void, protocol::LinkError> BallTransport::write(ByteView bytes) {
  const auto travel =
      Duration(1s) * static_cast<Duration::rep>(bytes.size()) / wire_.bytes_per_second;
  wire_free_ = std::max(wire_free_, now()) + travel;
  to_ball_.push_back({wire_free_ + wire_.round_trip / 2, {bytes.begin(), bytes.end()}});
  return {};
}

/// Moves what has arrived at either end by now.
void BallTransport::exchange() {
  while (!to_ball_.empty() && to_ball_.front().due <= now()) {
    ball_.receive(to_ball_.front().bytes);
    to_ball_.pop_front();
  }
  if (auto sent = ball_.take_output(); !sent.empty())
    to_client_.push_back({now() + wire_.round_trip / 2, std::move(sent)});
}

tl::expected<Bytes, protocol::LinkError> BallTransport::read(Instant deadline) {
  while (true) {
    exchange();
    if (!to_client_.empty() && to_client_.front().due <= now()) {
      auto arrived = std::move(to_client_.front().bytes);
      to_client_.pop_front();
      return arrived;
    }
    if (now() >= deadline)
      return Bytes{};
    auto next = std::min(deadline, ball_.next_event());
    if (!to_ball_.empty())
      next = std::min(next, to_ball_.front().due);
    if (!to_client_.empty())
      next = std::min(next, to_client_.front().due);
    if (next == never)
      return Bytes{};
    ball_.advance_to(std::max(next, now()));
  }
}

} // namespace orb::vm
