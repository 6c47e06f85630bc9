#include "vm/streamer.h"

#include "protocol/payload.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace orb::vm {
namespace {

constexpr std::size_t value_size = 2;

double sample(spec::StreamSource source, const Body& body, double accelerometer_g) {
  using enum spec::StreamSource;
  constexpr double raw_accel_g = 0.004;  // one unit: 4 mG
  constexpr double accel_units = 4096;   // a G
  constexpr double raw_gyro_deg = 0.068; // one unit
  constexpr double emf_cm = 22.5;        // one unit
  constexpr double pwm_units = 2047.0 / 255;
  const auto felt = [&](double g) { return std::clamp(g, -accelerometer_g, accelerometer_g); };
  const auto yaw = [&] {
    const auto deg = body.yaw_deg();
    return deg > 180 ? deg - 360 : deg;
  };
  switch (source) {
  case AccelXRaw: return felt(body.acceleration_g().x) / raw_accel_g;
  case AccelYRaw: return felt(body.acceleration_g().y) / raw_accel_g;
  case AccelZRaw: return felt(body.acceleration_g().z) / raw_accel_g;
  case GyroXRaw: return body.rotation_deg_s().x / raw_gyro_deg;
  case GyroYRaw: return body.rotation_deg_s().y / raw_gyro_deg;
  case GyroZRaw: return body.rotation_deg_s().z / raw_gyro_deg;
  case RightEmfRaw:
  case RightEmf: return body.right_motor_cm_s() / emf_cm;
  case LeftEmfRaw:
  case LeftEmf: return body.left_motor_cm_s() / emf_cm;
  case LeftPwm: return body.left_motor_power() * pwm_units;
  case RightPwm: return body.right_motor_power() * pwm_units;
  case Pitch: return body.pitch_deg();
  case Roll: return body.roll_deg();
  case Yaw: return yaw();
  case AccelX: return felt(body.acceleration_g().x) * accel_units;
  case AccelY: return felt(body.acceleration_g().y) * accel_units;
  case AccelZ: return felt(body.acceleration_g().z) * accel_units;
  case GyroX: return body.rotation_deg_s().x * 10;
  case GyroY: return body.rotation_deg_s().y * 10;
  case GyroZ: return body.rotation_deg_s().z * 10;
  case Q0: return body.attitude().w * 10000;
  case Q1: return body.attitude().x * 10000;
  case Q2: return body.attitude().y * 10000;
  case Q3: return body.attitude().z * 10000;
  case OdometerX: return body.pose().x_cm;
  case OdometerY: return body.pose().y_cm;
  case AccelOne: return body.acceleration_total_g() * 1000;
  case VelocityX: return body.velocity_cm_s().x * 10;
  case VelocityY: return body.velocity_cm_s().y * 10;
  }
  return 0;
}

std::uint64_t all_sources() {
  std::uint64_t mask = 0;
  for (const auto& row : spec::streams)
    mask |= row.mask;
  return mask;
}

} // namespace

bool Streamer::fits(const Request& request) {
  const auto values = static_cast<std::size_t>(std::popcount(request.mask & all_sources()));
  return values * value_size * request.frames <= spec::max_async_payload;
}

void Streamer::start(const Request& request, Instant now) {
  request_ = request;
  request_.mask &= all_sources();
  collected_ = 0;
  sent_ = 0;
  data_.clear();
  next_ = never;
  if (request_.mask == 0)
    return;
  // The samples lie on the grid of the control system.
  const auto since_step = now.time_since_epoch() % Body::step;
  next_ = now - since_step + Body::step * request_.divisor;
}

std::optional<protocol::Async> Streamer::run(Instant now, const Body& body) {
  if (now < next_)
    return std::nullopt;
  next_ += Body::step * request_.divisor;
  for (const auto& row : spec::streams)
    if ((row.mask & request_.mask) != 0) {
      const auto value = std::clamp<double>(
          std::round(sample(row.source, body, request_.accelerometer_g)), row.least, row.most);
      append_u16(data_, static_cast<std::uint32_t>(static_cast<std::int32_t>(value)));
    }
  if (++collected_ < request_.frames)
    return std::nullopt;
  const auto full = protocol::make_async(spec::AsyncId::SensorData, {data_});
  data_.clear();
  collected_ = 0;
  if (++sent_ == request_.packets)
    stop();
  return full;
}

} // namespace orb::vm
