#include "vm/body/drivetrain.h"

#include "vm/body/angles.h"

namespace orb::vm {

using namespace spec::ball; // the numbers of the model

void Drivetrain::power_on() {
  world_offset_deg_ += yaw_deg_;
  yaw_deg_ = target_deg_ = 0;
  forward_ = left_wheel_ = right_wheel_ = drift_x_ = drift_y_ = 0;
  rotate_left_deg_ = rotate_rate_ = yaw_rate_ = forward_acceleration_ = 0;
  stabilized_ = true;
  raw_ = false;
  left_ = right_ = {};
  target_speed_ = 0;
  go_ = Go::Brake;
  rotation_rate_ = default_rotation_rate;
  vector_drive_limit_ = default_vector_drive_limit;
}

Outcome Drivetrain::obey(const Roll& roll) {
  if (!stabilized_)
    return Outcome::Refused;
  target_deg_ = roll.heading_deg;
  target_speed_ = roll.go == Go::Brake ? 0 : roll.speed;
  go_ = roll.go;
  rotate_left_deg_ = 0;
  rotate_rate_ = 0;
  return Outcome::Done;
}

Outcome Drivetrain::obey(const Rotate& turn) {
  if (!stabilized_)
    return Outcome::Refused;
  const double least = std::abs(turn.angle_deg) / greatest_yaw_rate;
  rotate_left_deg_ = turn.angle_deg;
  rotate_rate_ = std::abs(turn.angle_deg) / std::max({least, seconds(turn.time), step_s});
  target_deg_ = wrap_360(yaw_deg_ + turn.angle_deg);
  return Outcome::Done;
}

Outcome Drivetrain::obey(const SetSpeed& change) {
  if (!stabilized_)
    return Outcome::Refused;
  target_speed_ = change.speed;
  go_ = roll_at(change.speed).go;
  return Outcome::Done;
}

Roll Drivetrain::roll_at(int speed) const {
  const auto heading = static_cast<int>(std::lround(target_deg_)) % full_circle;
  return {heading, speed, speed == 0 ? Go::Brake : Go::Drive};
}

Outcome Drivetrain::obey(const Stop&) {
  target_speed_ = 0;
  go_ = Go::Brake;
  if (raw_)
    left_ = right_ = {MotorMode::Off, 0};
  return Outcome::Done;
}

Outcome Drivetrain::obey(const RotationRate& rate) {
  rotation_rate_ = rate.deg_per_s;
  return Outcome::Done;
}

Outcome Drivetrain::obey(const Motors& motors) {
  const auto& [left, right] = motors;
  const auto ignored = [](const Motor& motor) { return motor.mode == MotorMode::Ignore; };
  if (ignored(left) && ignored(right))
    return Outcome::Refused;
  if (!raw_)
    left_wheel_ = right_wheel_ = forward_;
  raw_ = true;
  stabilized_ = false;
  target_speed_ = 0;
  rotate_left_deg_ = rotate_rate_ = 0;
  if (!ignored(left))
    left_ = left;
  if (!ignored(right))
    right_ = right;
  return Outcome::Done;
}

Outcome Drivetrain::obey(Stabilization mode) {
  if (mode == Stabilization::Off) {
    stabilized_ = false;
    target_speed_ = 0;
    rotate_left_deg_ = rotate_rate_ = 0;
    return Outcome::Done;
  }
  if (!stabilized_ || mode == Stabilization::OnAndReset) {
    target_deg_ = yaw_deg_;
    rotate_left_deg_ = rotate_rate_ = 0;
    if (!stabilized_)
      target_speed_ = 0;
  }
  stabilized_ = true;
  raw_ = false;
  left_wheel_ = right_wheel_ = 0;
  left_ = right_ = {};
  return Outcome::Done;
}

double Drivetrain::rename_heading(int heading_deg) {
  const double turned = yaw_deg_ - heading_deg;
  world_offset_deg_ += turned;
  yaw_deg_ = target_deg_ = heading_deg;
  rotate_left_deg_ = rotate_rate_ = 0;
  return turned;
}

void Drivetrain::push(Point velocity) {
  drift_x_ += velocity.x;
  drift_y_ += velocity.y;
}

void Drivetrain::bounce(Point velocity) {
  drift_x_ = velocity.x;
  drift_y_ = velocity.y;
  forward_ = left_wheel_ = right_wheel_ = 0;
}

/// The speed that it strives for.
double Drivetrain::commanded_cm_s() const {
  return full_speed * target_speed_ / greatest;
}

void Drivetrain::step() {
  turn();
  drive();
  lose_drift();
}

bool Drivetrain::stopped() const {
  return std::abs(forward_) < stopped_below &&
         (!drifts() || std::hypot(drift_x_, drift_y_) < stopped_below);
}

bool Drivetrain::fast_turn() const {
  return go_ == Go::FastTurn || stopped();
}

void Drivetrain::turn() {
  const double before = yaw_deg_;
  double turned = 0;
  if (!stabilized_) {
    const double wheels = raw_ ? (left_wheel_ - right_wheel_) / track / to_radians : 0;
    turned = std::clamp(wheels + spin_deg_s_, -greatest_yaw_rate, greatest_yaw_rate) * step_s;
  } else if (rotate_left_deg_ != 0) {
    const double most = rotate_rate_ * step_s;
    turned = std::clamp(rotate_left_deg_, -most, most);
    rotate_left_deg_ -= turned;
  } else {
    const double most = (fast_turn() ? fast_rotation_rate : rotation_rate_) * step_s;
    turned = std::clamp(shortest_turn(yaw_deg_, target_deg_), -most, most);
    if (std::abs(shortest_turn(yaw_deg_ + turned, target_deg_)) < 1e-9) {
      yaw_deg_ = target_deg_;
      yaw_rate_ = turned / step_s;
      return;
    }
  }
  yaw_deg_ = wrap_360(before + turned);
  yaw_rate_ = turned / step_s;
  if (stabilized_ && rotate_rate_ != 0) {
    if (rotate_left_deg_ == 0) {
      rotate_rate_ = 0;
      yaw_deg_ = target_deg_;
    }
  } else if (!stabilized_)
    target_deg_ = yaw_deg_;
}

void Drivetrain::drive() {
  const double before = forward_;
  if (raw_) {
    const auto wheel = [](double speed, const Motor& motor) {
      const double commanded = full_speed * motor.power / greatest;
      switch (motor.mode) {
      case MotorMode::Off: return toward(speed, 0, coasting * step_s);
      case MotorMode::Forward: return toward(speed, commanded, acceleration * step_s);
      case MotorMode::Reverse: return toward(speed, -commanded, acceleration * step_s);
      case MotorMode::Brake: return toward(speed, 0, braking * step_s);
      case MotorMode::Ignore: break;
      }
      return speed;
    };
    left_wheel_ = wheel(left_wheel_, left_);
    right_wheel_ = wheel(right_wheel_, right_);
    forward_ = (left_wheel_ + right_wheel_) / 2;
  } else if (!stabilized_) {
    forward_ = toward(forward_, 0, coasting * step_s);
  } else {
    const bool slow = std::abs(forward_) <= full_speed * vector_drive_limit_ / greatest;
    const bool waits =
        vector_drive_ == Switch::On && slow && std::abs(shortest_turn(yaw_deg_, target_deg_)) > 1;
    const double target = waits ? 0 : commanded_cm_s();
    forward_ = toward(forward_, target, (go_ == Go::Brake ? braking : acceleration) * step_s);
  }
  forward_acceleration_ = (forward_ - before) / step_s;
}

void Drivetrain::lose_drift() {
  if (!drifts())
    return;
  const double drift = std::hypot(drift_x_, drift_y_);
  const double left = std::max(0.0, drift - drift_friction * step_s) / drift;
  drift_x_ *= left;
  drift_y_ *= left;
}

const Course& Drivetrain::course() const {
  const double heading = yaw_deg_ + world_offset_deg_;
  if (course_.forward != forward_ || course_.heading_deg != heading ||
      course_.drift_x != drift_x_ || course_.drift_y != drift_y_) {
    const double vx = forward_ * std::sin(heading * to_radians) + drift_x_;
    const double vy = forward_ * std::cos(heading * to_radians) + drift_y_;
    course_ = {forward_, heading, drift_x_, drift_y_, vx, vy, std::hypot(vx, vy)};
  }
  return course_;
}

} // namespace orb::vm
