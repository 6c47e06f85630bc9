#include "vm/common/link.h"

#include "protocol/payload.h"
#include "spec/ball.h"
#include "spec/limits.h"

#include <algorithm>
#include <utility>

namespace orb::vm {

namespace {

constexpr std::int64_t bytes_per_second = spec::ball::wire_bytes_per_second;
constexpr auto print_queue_bytes =
    static_cast<std::size_t>(spec::value_of(spec::Limit::PrintQueueBytes));
constexpr std::size_t congested_bytes = spec::ball::congested_bytes;
constexpr std::int64_t second = Duration{1s}.count();

constexpr Duration time_of(std::size_t bytes) {
  // Round up, so that bytes never leave early.
  return Duration{(static_cast<std::int64_t>(bytes) * second + bytes_per_second - 1) /
                  bytes_per_second};
}

} // namespace

void Link::disconnect() {
  connected_ = false;
  packets_.clear();
  idle_at_ = {};
}

void Link::send(const protocol::Response& response, Instant now) {
  if (connected_)
    push(protocol::encode(response), now, Kind::Answer);
}

void Link::send(const protocol::Async& async, Instant now) {
  if (!connected_)
    return;
  if (holding_) {
    held_.push_back(async);
    return;
  }
  const auto id = static_cast<spec::AsyncId>(async.id);
  const bool vital = id == spec::AsyncId::BasicPrint || id == spec::AsyncId::BasicErrorText ||
                     id == spec::AsyncId::BasicError;
  if (!vital && waiting(now) > congested_bytes)
    ++dropped_;
  else
    push(protocol::encode(async), now, Kind::Message);
}

std::optional<Instant> Link::print(std::string_view text, Instant now) {
  if (!connected_)
    return std::nullopt;
  Bytes packet =
      protocol::encode(protocol::make_async(spec::AsyncId::BasicPrint, {as_bytes(text)}));
  const std::size_t room = print_queue_bytes - std::min(print_queue_bytes, packet.size());
  if (const Instant ready = drained_to(room, now); ready > now)
    return ready;
  push(std::move(packet), now, Kind::Message);
  return std::nullopt;
}

void Link::release_messages(Instant now) {
  holding_ = false;
  for (const auto& async : std::exchange(held_, {}))
    send(async, now);
}

std::uint32_t Link::clock_ms(Instant now) const {
  return static_cast<std::uint32_t>((now.time_since_epoch() + clock_offset_) / 1ms);
}

void Link::set_clock_ms(std::uint32_t value, Instant now) {
  clock_offset_ = std::chrono::milliseconds{value} - now.time_since_epoch();
}

void Link::push(Bytes packet, Instant now, Kind kind) {
  if (wire_ == Wire::Paced || kind == Kind::Message)
    idle_at_ = std::max(idle_at_, now) + time_of(packet.size());
  packets_.push_back({wire_ == Wire::Paced ? idle_at_ : now, std::move(packet)});
  ++sent_;
}

std::size_t Link::waiting(Instant now) const {
  if (idle_at_ <= now)
    return 0;
  return static_cast<std::size_t>(((idle_at_ - now).count() * bytes_per_second + second - 1) /
                                  second);
}

Instant Link::drained_to(std::size_t bytes, Instant now) const {
  return std::max(now, idle_at_ -
                           Duration{static_cast<std::int64_t>(bytes) * second / bytes_per_second});
}

std::optional<Bytes> Link::take(Instant now) {
  if (packets_.empty() || packets_.front().left > now)
    return std::nullopt;
  Bytes bytes = std::move(packets_.front().bytes);
  packets_.pop_front();
  return bytes;
}

} // namespace orb::vm
