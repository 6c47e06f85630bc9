#include "vm/body/motion_sensors.h"

#include "base/random.h"
#include "vm/body/angles.h"

namespace orb::vm {

using namespace spec::ball; // figures of the model

void MotionSensors::shake(Instant now) {
  shaken_until_ = now + shake_time;
}

void MotionSensors::toss(Instant now, Duration time) {
  falling_until_ = now + time;
  landing_ = true;
}

void MotionSensors::tilt(double pitch_deg, double roll_deg) {
  tilt_pitch_deg_ = pitch_deg;
  tilt_roll_deg_ = roll_deg;
}

void MotionSensors::strike(Instant now) {
  struck_until_ = now + blow_time;
}

void MotionSensors::step(Instant now) {
  if (landing_ && now >= falling_until_) {
    landing_ = false;
    strike(now);
  }
}

double MotionSensors::pitch_deg(const Movement& movement) const {
  const double lifted = arctangent(movement.forward_acceleration_cm_s2, gravity) / to_radians;
  return std::clamp(tilt_pitch_deg_ + lifted + noise(0, movement.at) * noise_deg, -half_circle / 2,
                    half_circle / 2);
}

double MotionSensors::roll_deg(Instant now) const {
  return std::clamp(tilt_roll_deg_ + noise(1, now) * noise_deg, -half_circle, half_circle);
}

Vector3 MotionSensors::acceleration_g(const Movement& movement) const {
  const auto now = movement.at;
  if (now < falling_until_)
    return {};
  const double pitch = tilt_pitch_deg_ * to_radians;
  const double roll = tilt_roll_deg_ * to_radians;
  Vector3 felt{-vm::sine(roll) * vm::cosine(pitch) + movement.sideways_acceleration_cm_s2 / gravity,
               vm::sine(pitch) + movement.forward_acceleration_cm_s2 / gravity,
               vm::cosine(roll) * vm::cosine(pitch)};
  if (now < shaken_until_)
    felt.x += (shaken_until_ - now) / shake_half_period % 2 == 0 ? shake_g : -shake_g;
  if (now < struck_until_)
    felt.y += blow_g;
  felt.x += noise(2, now) * noise_g;
  felt.y += noise(3, now) * noise_g;
  felt.z += noise(4, now) * noise_g;
  return felt;
}

Vector3 MotionSensors::rotation_deg_s(const Movement& movement) const {
  return {noise(5, movement.at) * noise_deg, noise(6, movement.at) * noise_deg,
          movement.yaw_rate_deg_s + noise(7, movement.at) * noise_deg};
}

Quaternion MotionSensors::attitude(const Movement& movement) const {
  // Headings grow clockwise, quaternions counter-clockwise about Z.
  const double yaw = -movement.yaw_deg * to_radians / 2;
  const double pitch = pitch_deg(movement) * to_radians / 2;
  const double roll = roll_deg(movement.at) * to_radians / 2;
  const double cy = vm::cosine(yaw), sy = vm::sine(yaw);
  const double cp = vm::cosine(pitch), sp = vm::sine(pitch);
  const double cr = vm::cosine(roll), sr = vm::sine(roll);
  return {cr * cp * cy + sr * sp * sy, cr * sp * cy + sr * cp * sy, sr * cp * cy - cr * sp * sy,
          cr * cp * sy - sr * sp * cy};
}

double MotionSensors::noise(std::uint32_t channel, Instant now) const {
  if (noise_ == Switch::Off)
    return 0;
  // One value per channel and control-system step, so that repeated reads agree.
  Random random{seed_ + Random::stride * channel +
                static_cast<std::uint64_t>(now.time_since_epoch() / control_step)};
  return static_cast<double>(random.next() >> 11) * 0x1p-53 * 2 - 1; // -1 to 1 from 53 bits
}

} // namespace orb::vm
