#include "vm/device.h"

#include "spec/robots.h"
#include "vm/common/bluetooth.h"

#include <algorithm>

namespace orb::vm {

Device::Device(const BallOptions& options) : ball_(options) {
  if (spec::info(options.robot).packets == spec::Packets::V2)
    v2_.emplace(ball_, options.robot, bluetooth_address(options.seed));
}

Device::Device(const Device& other, Observer* observer) : ball_(other.ball_) {
  ball_.tell(observer);
  if (other.v2_)
    v2_.emplace(*other.v2_, ball_);
}

void Device::connect() {
  ball_.connect();
  if (v2_)
    v2_->connect();
}

void Device::disconnect() {
  if (v2_)
    v2_->disconnect();
  ball_.disconnect();
}

void Device::receive(ByteView bytes) {
  if (!v2_)
    return ball_.receive(bytes);
  v2_->receive(bytes);
  v2_->run(); // report at once what the request caused
}

std::optional<Bytes> Device::take_packet() {
  return v2_ ? v2_->take_packet() : ball_.take_packet();
}

void Device::advance_to(Instant target, Ball::Halt halt) {
  if (!v2_)
    return ball_.advance_to(target, halt);
  do {
    ball_.advance_until_output(std::clamp(v2_->next_event(), now(), std::max(now(), target)), halt);
    v2_->run();
  } while (now() < target);
}

Instant Device::next_event() const {
  const auto next = ball_.next_event();
  return v2_ ? std::max(now(), std::min(next, v2_->next_event())) : next;
}

} // namespace orb::vm
