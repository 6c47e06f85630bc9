// Device 02h: driving, lamps and sensors.

#include "vm/api/dispatch.h"

#include <algorithm>
#include <cmath>

namespace orb::vm {
namespace {

using spec::ResponseCode;

using namespace spec::ball;

int wrap_degrees(std::int64_t degrees) {
  return static_cast<int>((degrees % full_circle + full_circle) % full_circle);
}

std::int64_t s16(double value) {
  return std::lround(std::clamp<double>(value, INT16_MIN, INT16_MAX));
}

} // namespace

HANDLE(SetHeading) {
  host_->drive(SetHeading{static_cast<int>(call.operands.number(0))});
  gyro_exceeded_ = 0;
  return {};
}

HANDLE(SetStabilization) {
  host_->drive(call.operands.u8(0) == 0 ? Stabilization::Off : Stabilization::OnAndReset);
  return {};
}

HANDLE(SetRotationRate) {
  const auto rate = std::max<std::uint8_t>(1, call.operands.u8(0));
  host_->drive(RotationRate{rate == greatest ? rotation_greatest : rate * rotation_unit});
  return {};
}

HANDLE(SelfLevel) {
  const SelfLevel::Request request{call.operands.u8(0), call.operands.u8(1), call.operands.u8(2),
                                   call.operands.u8(3)};
  level(request);
  return {};
}

void Dispatcher::level(const SelfLevel::Request& request) {
  if ((request.options & spec::self_level_options::start) == 0) {
    if (self_level_.running())
      finish_levelling(spec::self_level_result::aborted);
    return;
  }
  self_level_.start(request, host_->body(), host_->now());
  if (host_->settings().has(spec::permanent_option_flags::no_self_level))
    return finish_levelling(spec::self_level_result::disabled);
  host_->drive(Stabilization::On);
  host_->drive(Stop{});
}

void Dispatcher::finish_levelling(std::uint8_t result) {
  namespace option = spec::self_level_options;
  using namespace spec::self_level_result;
  self_level_.stop();
  if (result == success && self_level_.wants(option::final_angle))
    host_->body().obey(
        Roll{static_cast<int>(std::lround(self_level_.first_heading_deg())) % full_circle, 0,
             Go::FastTurn});
  if (result == success || result == timed_out)
    host_->drive(self_level_.wants(option::control_system) ? Stabilization::On
                                                           : Stabilization::Off);
  host_->send(protocol::make_async(spec::AsyncId::SelfLevelResult, {result}));
  if (self_level_.wants(option::sleep) && result != aborted)
    host_->sleep({});
}

HANDLE(SetVectorDriveLimit) {
  host_->body().set_vector_drive_limit(call.operands.u8(0));
  return {};
}

HANDLE(SetDataStreaming) {
  const auto low = static_cast<std::uint64_t>(call.operands.number(2));
  const auto high = static_cast<std::uint64_t>(call.operands.number(4));
  const Streamer::Request request{.divisor = static_cast<std::uint32_t>(call.operands.number(0)),
                                  .frames = static_cast<std::uint32_t>(call.operands.number(1)),
                                  .mask = low | high << 32,
                                  .packets = call.operands.u8(3),
                                  .accelerometer_g = 2.0 * (1 << accelerometer_range_)};
  if (request.mask != 0 &&
      (request.divisor == 0 || request.frames == 0 || !Streamer::fits(request)))
    return {ResponseCode::BadParameter, {}};
  host_->streamer().start(request, host_->now());
  return {};
}

HANDLE(ConfigureCollisionDetection) {
  const auto& values = call.operands;
  host_->set(&Settings::collisions, CollisionSettings{values.u8(0), values.u8(1), values.u8(2),
                                                      values.u8(3), values.u8(4), values.u8(5)});
  return {};
}

HANDLE(ConfigureLocator) {
  auto& body = host_->body();
  const auto corrects = (call.operands.u8(0) & spec::locator_flags::auto_tare) != 0;
  body.set_tare_correction(corrects ? Switch::On : Switch::Off);
  body.locate(static_cast<double>(call.operands.number(1)),
              static_cast<double>(call.operands.number(2)));
  body.set_yaw_tare(wrap_degrees(call.operands.number(3)));
  return {};
}

HANDLE(SetAccelerometerRange) {
  accelerometer_range_ = call.operands.u8(0);
  return {};
}

HANDLE(ReadLocator) {
  const auto& body = host_->body();
  const auto place = body.told_locator_cm();
  const auto velocity = body.told_velocity_cm_s();
  return call.answer(
      {s16(place.x), s16(place.y), s16(velocity.x), s16(velocity.y), s16(body.pose().speed_cm_s)});
}

HANDLE(SetRgbLed) {
  const Color color{call.operands.u8(0), call.operands.u8(1), call.operands.u8(2)};
  host_->set_led(color);
  if (call.operands.u8(3) != 0) {
    host_->set(&Settings::user_color, color);
    persist();
  }
  return {};
}

HANDLE(SetBackLed) {
  host_->set_back_led(call.operands.u8(0));
  return {};
}

HANDLE(GetRgbLed) {
  const auto color = host_->settings().user_color;
  return call.answer({color.red, color.green, color.blue});
}

HANDLE(Roll) {
  const auto speed = call.operands.u8(0);
  // Leniency: a roll without its third operand drives, or brakes if its speed is 0.
  const auto go = call.operands.has(2) ? static_cast<Go>(call.operands.u8(2))
                  : speed > 0          ? Go::Drive
                                       : Go::Brake;
  profile_.soul.stop_boost();
  host_->drive(Roll{static_cast<int>(call.operands.number(1)), speed, go});
  return {};
}

HANDLE(Boost) {
  const auto on = call.operands.u8(0) != 0;
  if (on && !profile_.soul.start_boost())
    return {ResponseCode::ExecuteFailed, {}};
  boost(on ? Switch::On : Switch::Off);
  return {};
}

/// Implements the boost macro: full speed along the present heading until the bank is empty [?].
void Dispatcher::boost(Switch state) {
  const auto heading = wrap_degrees(std::lround(host_->body().heading_setpoint_deg()));
  if (state == Switch::On) {
    speed_before_boost_ = host_->body().speed_setpoint();
    host_->drive(Roll{heading, boost_speed, Go::Drive});
    soul_tick_at_ = std::min(soul_tick_at_, host_->now() + soul_tick);
    return;
  }
  profile_.soul.stop_boost();
  host_->drive(Roll{heading, speed_before_boost_, speed_before_boost_ > 0 ? Go::Drive : Go::Brake});
}

HANDLE(SetRawMotorValues) {
  const auto& values = call.operands;
  profile_.soul.stop_boost();
  host_->drive(Motors{{static_cast<MotorMode>(values.u8(0)), values.u8(1)},
                      {static_cast<MotorMode>(values.u8(2)), values.u8(3)}});
  return {};
}

HANDLE(SetMotionTimeout) {
  host_->set<Duration>(&Settings::motion_timeout,
                       std::chrono::milliseconds{call.operands.number(0)});
  return {};
}

} // namespace orb::vm
