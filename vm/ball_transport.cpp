#include "vm/ball_transport.h"

#include <algorithm>

namespace orb::vm {

BallTransport::BallTransport(Ball& ball, const WireModel& wire) : ball_(ball), wire_(wire) {
  ball_.connect();
}

BallTransport::BallTransport(Ball& ball, RobotV2& robot, const WireModel& wire)
    : ball_(ball), robot_(&robot), wire_(wire) {
  ball_.connect();
  robot_->connect();
}

BallTransport::~BallTransport() {
  if (robot_ != nullptr)
    robot_->disconnect();
  ball_.disconnect();
}

tl::expected<void, protocol::LinkError> BallTransport::write(ByteView bytes) {
  const auto travel =
      Duration(1s) * static_cast<Duration::rep>(bytes.size()) / wire_.bytes_per_second;
  wire_free_ = std::max(wire_free_, now()) + travel;
  to_ball_.push_back({wire_free_ + wire_.round_trip / 2, {bytes.begin(), bytes.end()}});
  return {};
}

Bytes BallTransport::take_output() {
  if (robot_ == nullptr)
    return ball_.take_output();
  Bytes out;
  robot_->run();
  while (const auto packet = robot_->take_packet())
    out.insert(out.end(), packet->begin(), packet->end());
  return out;
}

/// Delivers everything that has arrived at either end by now.
void BallTransport::exchange() {
  while (!to_ball_.empty() && to_ball_.front().due <= now()) {
    if (robot_ != nullptr)
      robot_->receive(to_ball_.front().bytes);
    else
      ball_.receive(to_ball_.front().bytes);
    to_ball_.pop_front();
  }
  if (auto sent = take_output(); !sent.empty())
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
    if (robot_ != nullptr)
      next = std::min(next, robot_->next_event());
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
