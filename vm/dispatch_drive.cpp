// Device 02h: driving, lamps and sensors.

#include "vm/dispatch.h"

#include <algorithm>
#include <cmath>

namespace orb::vm {
namespace {

using spec::ResponseCode;

constexpr double rotation_unit_deg_s = 0.784;   // API §Set Rotation Rate
constexpr double rotation_greatest_deg_s = 400; // API §Set Rotation Rate
constexpr std::uint8_t rotation_rate_most = 255;
constexpr int boost_speed = 255; // [?]

int wrap_degrees(std::int64_t degrees) {
  return static_cast<int>((degrees % 360 + 360) % 360);
}

std::int64_t s16(double value) {
  return std::lround(std::clamp<double>(value, INT16_MIN, INT16_MAX));
}

} // namespace

HANDLE(SetHeading) {
  call.ball.set_heading(Actor::Client, static_cast<int>(call.operands.number(0)));
  gyro_exceeded_ = 0;
  return {};
}

HANDLE(SetStabilization) {
  call.ball.set_stabilization(Actor::Client, call.operands.u8(0) == 0 ? Stabilization::Off
                                                                      : Stabilization::OnAndReset);
  return {};
}

HANDLE(SetRotationRate) {
  const auto rate = std::max<std::uint8_t>(1, call.operands.u8(0));
  call.ball.set_rotation_rate(Actor::Client, rate == rotation_rate_most
                                                 ? rotation_greatest_deg_s
                                                 : rate * rotation_unit_deg_s);
  return {};
}

HANDLE(SelfLevel) {
  const SelfLevel::Request request{call.operands.u8(0), call.operands.u8(1), call.operands.u8(2),
                                   call.operands.u8(3)};
  if ((request.options & spec::self_level_options::start) != 0)
    self_level_.start(request, call.ball);
  else
    self_level_.abort(call.ball);
  return {};
}

HANDLE(SetVectorDriveLimit) {
  call.ball.body().set_vector_drive_limit(call.operands.u8(0));
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
  call.ball.streamer().start(request, call.ball.now());
  return {};
}

HANDLE(ConfigureCollisionDetection) {
  const auto& values = call.operands;
  call.ball.settings().collisions = {values.u8(0), values.u8(1), values.u8(2),
                                     values.u8(3), values.u8(4), values.u8(5)};
  return {};
}

HANDLE(ConfigureLocator) {
  auto& body = call.ball.body();
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
  const auto pose = call.ball.body().pose();
  const auto velocity = call.ball.body().velocity_cm_s();
  return call.answer(
      {s16(pose.x_cm), s16(pose.y_cm), s16(velocity.x), s16(velocity.y), s16(pose.speed_cm_s)});
}

HANDLE(SetRgbLed) {
  const Color color{call.operands.u8(0), call.operands.u8(1), call.operands.u8(2)};
  call.ball.set_led(Actor::Client, color);
  if (call.operands.u8(3) != 0) {
    call.ball.settings().user_color = color;
    call.ball.settings_changed();
    persist();
  }
  return {};
}

HANDLE(SetBackLed) {
  call.ball.set_back_led(Actor::Client, call.operands.u8(0));
  return {};
}

HANDLE(GetRgbLed) {
  const auto color = call.ball.settings().user_color;
  return call.answer({color.red, color.green, color.blue});
}

HANDLE(Roll) {
  const auto speed = call.operands.u8(0);
  // Without its third value a roll drives, and one of speed 0 brakes (leniency).
  const auto go = call.operands.has(2) ? static_cast<Go>(call.operands.u8(2))
                  : speed > 0          ? Go::Drive
                                       : Go::Brake;
  profile_.soul.stop_boost();
  call.ball.roll(Actor::Client, {static_cast<int>(call.operands.number(1)), speed, go});
  return {};
}

HANDLE(Boost) {
  const auto on = call.operands.u8(0) != 0;
  if (on && !profile_.soul.start_boost())
    return {ResponseCode::ExecuteFailed, {}};
  set_boost(on, call.ball);
  return {};
}

/// The boost macro: full speed along the present heading until the bank is empty [?].
void Dispatcher::set_boost(bool on, Ball& ball) {
  const auto heading = wrap_degrees(std::lround(ball.body().heading_setpoint_deg()));
  if (on) {
    speed_before_boost_ = ball.body().speed_setpoint();
    ball.roll(Actor::Client, {heading, boost_speed, Go::Drive});
    soul_tick_at_ = std::min(soul_tick_at_, ball.now() + Soul::tick_time);
    return;
  }
  profile_.soul.stop_boost();
  ball.roll(Actor::Client,
            {heading, speed_before_boost_, speed_before_boost_ > 0 ? Go::Drive : Go::Brake});
}

HANDLE(SetRawMotorValues) {
  const auto& values = call.operands;
  profile_.soul.stop_boost();
  call.ball.set_motors(Actor::Client, {static_cast<MotorMode>(values.u8(0)), values.u8(1)},
                       {static_cast<MotorMode>(values.u8(2)), values.u8(3)});
  return {};
}

HANDLE(SetMotionTimeout) {
  call.ball.settings().motion_timeout = std::chrono::milliseconds{call.operands.number(0)};
  return {};
}

} // namespace orb::vm
