#pragma once

#include "base/time.h"
#include "vm/body/motion.h"
#include "vm/body/place.h"

#include <cstdint>

namespace orb::vm {

/// Motion of the ball at an instant, as far as accelerometer and gyro sense it.
struct Movement {
  Instant at{};
  double yaw_deg = 0;
  double yaw_rate_deg_s = 0;
  double forward_acceleration_cm_s2 = 0;
  double sideways_acceleration_cm_s2 = 0; ///< to the right
};

/// Accelerometer and gyro, and what hands do to them: shakes, tosses, tilts, noise.
class MotionSensors {
public:
  explicit MotionSensors(std::uint64_t seed) : seed_(seed) {}

  void shake(Instant now);
  /// Free fall for `time`, then a hard landing.
  void toss(Instant now, Duration time);
  void tilt(double pitch_deg, double roll_deg);
  void set_noise(Switch noise) { noise_ = noise; }
  /// Registers a blow at `now`.
  void strike(Instant now);

  /// Returns true while a landing is pending.
  bool falls() const { return landing_; }
  /// Lands if the fall is over.
  void step(Instant now);

  double pitch_deg(const Movement& movement) const; ///< -90..90
  double roll_deg(Instant now) const;               ///< -180..180
  Vector3 acceleration_g(const Movement& movement) const;
  Vector3 rotation_deg_s(const Movement& movement) const;
  Quaternion attitude(const Movement& movement) const;

private:
  double noise(std::uint32_t channel, Instant now) const;

  std::uint64_t seed_;
  double tilt_pitch_deg_ = 0;
  double tilt_roll_deg_ = 0;
  Switch noise_ = Switch::Off;
  Instant shaken_until_{};
  Instant falling_until_{};
  bool landing_ = false;
  Instant struck_until_{};
};

} // namespace orb::vm
