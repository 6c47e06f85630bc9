#include "vm/self_level.h"

#include <cmath>

namespace orb::vm {
namespace {

constexpr std::uint8_t default_angle_limit_deg = 3; // API §Self Level
constexpr std::uint8_t default_timeout_s = 15;      // API §Self Level
constexpr std::uint8_t default_true_time_10ms = 30; // API §Self Level
constexpr Duration poll_time = std::chrono::milliseconds{10};

std::uint8_t or_default(std::uint8_t value, std::uint8_t fallback) {
  return value == 0 ? fallback : value;
}

} // namespace

void SelfLevel::start(const Request& request, const Body& body, Instant now) {
  request_ = request;
  request_.angle_limit_deg = or_default(request.angle_limit_deg, default_angle_limit_deg);
  request_.timeout_s = or_default(request.timeout_s, default_timeout_s);
  request_.true_time_10ms = or_default(request.true_time_10ms, default_true_time_10ms);
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
  next_ = now + poll_time;
  return std::nullopt;
}

} // namespace orb::vm
