#include "vm/output.h"

#include "spec/limits.h"

#include <algorithm>

namespace orb::vm {

namespace {

constexpr auto bytes_per_second =
    static_cast<std::int64_t>(spec::value_of(spec::Limit::PrintQueueBytesPerSecond));
constexpr std::int64_t second = 1'000'000'000;

constexpr Duration time_of(std::size_t bytes) {
  // Rounded up, so that the instants at which bytes have left are never early.
  return Duration{(static_cast<std::int64_t>(bytes) * second + bytes_per_second - 1) /
                  bytes_per_second};
}

} // namespace

void Output::push(Bytes packet, Instant now, Kind kind) {
  if (wire_ == Wire::Paced || kind == Kind::Message)
    idle_at_ = std::max(idle_at_, now) + time_of(packet.size());
  packets_.push_back({wire_ == Wire::Paced ? idle_at_ : now, std::move(packet)});
}

std::size_t Output::waiting(Instant now) const {
  if (idle_at_ <= now)
    return 0;
  return static_cast<std::size_t>(((idle_at_ - now).count() * bytes_per_second + second - 1) /
                                  second);
}

Instant Output::drained_to(std::size_t bytes, Instant now) const {
  return std::max(now, idle_at_ -
                           Duration{static_cast<std::int64_t>(bytes) * second / bytes_per_second});
}

std::optional<Bytes> Output::take(Instant now) {
  if (packets_.empty() || packets_.front().left > now)
    return std::nullopt;
  Bytes bytes = std::move(packets_.front().bytes);
  packets_.pop_front();
  return bytes;
}

void Output::clear() {
  packets_.clear();
  idle_at_ = {};
}

} // namespace orb::vm
