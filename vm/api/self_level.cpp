#include "vm/api/self_level.h"

#include <cmath>

namespace orb::vm {
namespace {

using namespace spec::ball;

std::uint8_t or_default(std::uint8_t value, int fallback) {
  return value == 0 ? static_cast<std::uint8_t>(fallback) : value;
}

} // namespace

void SelfLevel::start(const Request& request, const Body& body, Instant now) {
  request_ = request;
  request_.angle_limit_deg = or_default(request.angle_limit_deg, default_angle_limit);
  request_.timeout_s = or_default(request.timeout_s, default_level_timeout);
  request_.true_time_10ms = or_default(request.true_time_10ms, default_true_time);
  first_heading_deg_ = body.yaw_deg();
  level_since_.reset();
  deadline_ = now + std::chrono::seconds{request_.timeout_s};
  next_ = now;
}

std::optional<std::uint8_t> SelfLevel::run(Instant now, const Body& body) {
  if (now < next_)
    return std::nullopt;
  const auto limit = static_cast<double>(request_.angle_limit_deg);
  const auto level = std::abs(body.pitch_deg()) < limit && std::abs(body.roll_deg()) < limit;
  if (!level)
    level_since_.reset();
  else if (!level_since_)
    level_since_ = now;
  next_ = never;
  if (level_since_ &&
      now - *level_since_ >= std::chrono::milliseconds{10} * request_.true_time_10ms)
    return spec::self_level_result::success;
  if (now >= deadline_)
    return spec::self_level_result::timed_out;
  next_ = now + level_check_interval;
  return std::nullopt;
}

} // namespace orb::vm
