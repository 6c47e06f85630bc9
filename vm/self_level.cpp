#include "vm/self_level.h"

#include "vm/ball.h"

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

void SelfLevel::start(const Request& request, Ball& ball) {
  request_ = request;
  request_.angle_limit_deg = or_default(request.angle_limit_deg, default_angle_limit_deg);
  request_.timeout_s = or_default(request.timeout_s, default_timeout_s);
  request_.true_time_10ms = or_default(request.true_time_10ms, default_true_time_10ms);
  if ((ball.settings().permanent_flags & spec::permanent_option_flags::no_self_level) != 0) {
    finish(spec::self_level_result::disabled, ball);
    return;
  }
  first_heading_deg_ = ball.body().yaw_deg();
  ball.set_stabilization(Actor::Client, Stabilization::On);
  ball.stop(Actor::Client);
  level_since_.reset();
  deadline_ = ball.now() + std::chrono::seconds{request_.timeout_s};
  next_ = ball.now();
}

void SelfLevel::abort(Ball& ball) {
  if (running())
    finish(spec::self_level_result::aborted, ball);
}

void SelfLevel::run(Instant now, Ball& ball) {
  if (now < next_)
    return;
  const auto limit = static_cast<double>(request_.angle_limit_deg);
  const auto level =
      std::abs(ball.body().pitch_deg()) < limit && std::abs(ball.body().roll_deg()) < limit;
  if (!level)
    level_since_.reset();
  else if (!level_since_)
    level_since_ = now;
  if (level_since_ &&
      now - *level_since_ >= std::chrono::milliseconds{10} * request_.true_time_10ms)
    return finish(spec::self_level_result::success, ball);
  if (now >= deadline_)
    return finish(spec::self_level_result::timed_out, ball);
  next_ = now + poll_time;
}

void SelfLevel::finish(std::uint8_t result, Ball& ball) {
  next_ = never;
  const auto wants = [&](std::uint32_t option) { return (request_.options & option) != 0; };
  if (result == spec::self_level_result::success && wants(spec::self_level_options::final_angle))
    ball.body().roll({static_cast<int>(std::lround(first_heading_deg_)) % 360, 0, Go::FastTurn});
  if (result == spec::self_level_result::success || result == spec::self_level_result::timed_out)
    ball.set_stabilization(Actor::Client, wants(spec::self_level_options::control_system)
                                              ? Stabilization::On
                                              : Stabilization::Off);
  ball.send(protocol::make_async(spec::AsyncId::SelfLevelResult, {result}));
  if (wants(spec::self_level_options::sleep) && result != spec::self_level_result::aborted)
    ball.sleep({});
}

} // namespace orb::vm
