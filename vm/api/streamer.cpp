#include "vm/api/streamer.h"

#include "protocol/payload.h"
#include "spec/ball.h"
#include "spec/unit.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace orb::vm {
namespace {

constexpr std::size_t value_size = 2;

/// Reads a source in the unit of its row: G, degrees, cm or seconds.
double sample(spec::StreamSource source, const Body& body, double accelerometer_g) {
  using enum spec::StreamSource;
  using namespace spec::ball;
  const auto felt = [&](double g) { return std::clamp(g, -accelerometer_g, accelerometer_g); };
  const auto yaw = [&] {
    const auto deg = body.yaw_deg();
    return deg > full_circle / 2 ? deg - full_circle : deg;
  };
  switch (source) {
  case AccelXRaw:
  case AccelX: return felt(body.acceleration_g().x);
  case AccelYRaw:
  case AccelY: return felt(body.acceleration_g().y);
  case AccelZRaw:
  case AccelZ: return felt(body.acceleration_g().z);
  case GyroXRaw:
  case GyroX: return body.rotation_deg_s().x;
  case GyroYRaw:
  case GyroY: return body.rotation_deg_s().y;
  case GyroZRaw:
  case GyroZ: return body.rotation_deg_s().z;
  case RightEmfRaw:
  case RightEmf: return body.right_motor_cm_s();
  case LeftEmfRaw:
  case LeftEmf: return body.left_motor_cm_s();
  case LeftPwm: return body.left_motor_power() / double{greatest};
  case RightPwm: return body.right_motor_power() / double{greatest};
  case Pitch: return body.pitch_deg();
  case Roll: return body.roll_deg();
  case Yaw: return yaw();
  case Q0: return body.attitude().w;
  case Q1: return body.attitude().x;
  case Q2: return body.attitude().y;
  case Q3: return body.attitude().z;
  case OdometerX: return body.told_locator_cm().x;
  case OdometerY: return body.told_locator_cm().y;
  case AccelOne: return body.acceleration_total_g();
  case VelocityX: return body.told_velocity_cm_s().x;
  case VelocityY: return body.told_velocity_cm_s().y;
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
  // Align samples with the steps of the control system.
  const auto since_step = now.time_since_epoch() % Body::step;
  next_ = now - since_step + Body::step * request_.divisor;
}

std::optional<protocol::Async> Streamer::run(Instant now, const Body& body) {
  if (now < next_)
    return std::nullopt;
  next_ += Body::step * request_.divisor;
  for (const auto& row : spec::streams)
    if ((row.mask & request_.mask) != 0) {
      const auto steps =
          spec::scale_of(row.unit).of(sample(row.source, body, request_.accelerometer_g));
      const auto value = std::clamp<double>(std::round(steps), row.least, row.most);
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
