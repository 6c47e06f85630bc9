#include "vm/body/drivetrain.h"
#include "vm/body/trigonometry.h"

namespace orb::vm {

using namespace spec::ball; // figures of the model

void Drivetrain::power_on() {
  forget_orders();
  world_offset_deg_ += yaw_deg_;
  yaw_deg_ = target_deg_ = aim_deg_ = 0;
  forward_ = slip_ = left_wheel_ = right_wheel_ = drift_x_ = drift_y_ = 0;
  rotate_left_deg_ = rotate_rate_ = 0;
  rest();
  stabilized_ = true;
  raw_ = false;
  left_ = right_ = {};
  rotation_rate_ = default_rotation_rate;
  vector_drive_limit_ = default_vector_drive_limit;
}

/// Queues an order. A second order within the same step replaces the first.
void Drivetrain::give(Order order) {
  order.due = steps_ + static_cast<std::uint32_t>(numbers_.dead_steps);
  target_speed_ = order.speed;
  if (waiting_ > 0 && waiting(waiting_ - 1).due == order.due) {
    Order& last = waiting(waiting_ - 1);
    if (order.heading_deg == Order::same_heading)
      order.heading_deg = last.heading_deg;
    last = order;
    return;
  }
  waiting(waiting_++) = order;
}

/// Passes the orders that are due to the motors.
void Drivetrain::take_orders() {
  for (; waiting_ > 0 && waiting(0).due == steps_; --waiting_) {
    const Order order = waiting(0);
    if (order.heading_deg != Order::same_heading)
      aim_deg_ = order.heading_deg;
    const double aim = spec::speed_cm_s(numbers_, order.speed);
    aim_cm_s_ = order.way == Way::Ahead ? aim : -aim;
    go_ = order.go;
    first_ = (first_ + 1) % orders_.size();
  }
  ++steps_;
}

/// An immediate turn or renaming invalidates the headings of queued orders, but not their speeds.
void Drivetrain::forget_headings() {
  for (std::size_t place = 0; place < waiting_; ++place)
    waiting(place).heading_deg = Order::same_heading;
}

void Drivetrain::forget_orders() {
  waiting_ = 0;
  target_speed_ = 0;
  aim_cm_s_ = 0;
  go_ = Go::Brake;
}

Outcome Drivetrain::obey(const Roll& roll) {
  if (!stabilized_)
    return Outcome::Refused;
  if (rotate_left_deg_ != 0) // it holds the heading it has turned to until the order arrives
    aim_deg_ = yaw_deg_;
  rotate_left_deg_ = rotate_rate_ = 0;
  target_deg_ = roll.heading_deg;
  give({.heading_deg = static_cast<std::int16_t>(roll.heading_deg),
        .speed = static_cast<std::uint8_t>(roll.go == Go::Brake ? 0 : roll.speed),
        .go = roll.go,
        .way = roll.way});
  return Outcome::Done;
}

Outcome Drivetrain::obey(const Rotate& turn) {
  if (!stabilized_)
    return Outcome::Refused;
  const double least = std::abs(turn.angle_deg) / greatest_yaw_rate;
  rotate_left_deg_ = turn.angle_deg;
  rotate_rate_ = std::abs(turn.angle_deg) / std::max({least, seconds(turn.time), step_s});
  target_deg_ = aim_deg_ = wrap_360(yaw_deg_ + turn.angle_deg);
  forget_headings();
  return Outcome::Done;
}

Outcome Drivetrain::obey(const SetSpeed& change) {
  if (!stabilized_)
    return Outcome::Refused;
  give({.speed = static_cast<std::uint8_t>(change.speed), .go = roll_at(change.speed).go});
  return Outcome::Done;
}

Roll Drivetrain::roll_at(int speed) const {
  const auto heading = static_cast<int>(std::lround(target_deg_)) % full_circle;
  return {heading, speed, speed == 0 ? Go::Brake : Go::Drive};
}

Outcome Drivetrain::obey(const Stop&) {
  give({.speed = 0, .go = Go::Brake});
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
  forget_orders();
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
    forget_orders();
    rotate_left_deg_ = rotate_rate_ = 0;
    return Outcome::Done;
  }
  if (!stabilized_ || mode == Stabilization::OnAndReset) {
    target_deg_ = aim_deg_ = yaw_deg_;
    rotate_left_deg_ = rotate_rate_ = 0;
    forget_headings();
    if (!stabilized_)
      forget_orders();
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
  yaw_deg_ = target_deg_ = aim_deg_ = heading_deg;
  forget_headings();
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
  forward_ = slip_ = left_wheel_ = right_wheel_ = 0;
}

void Drivetrain::press(Point change) {
  if (forward_ == 0 && slip_ == 0)
    return push(change);
  const auto& way = way_.of(yaw_deg_ + world_offset_deg_);
  const double forward = change.x * way.sine() + change.y * way.cosine();
  forward_ += forward;
  left_wheel_ += forward;
  right_wheel_ += forward;
  slip_ += change.x * way.cosine() - change.y * way.sine();
}

void Drivetrain::step() {
  take_orders();
  turn();
  drive();
  lose_slip();
  lose_drift();
}

bool Drivetrain::stopped() const {
  return std::abs(forward_) < stopped_below && std::abs(slip_) < stopped_below &&
         (!drifts() || vm::length(drift_x_, drift_y_) < stopped_below);
}

bool Drivetrain::fast_turn() const {
  return go_ == Go::FastTurn || stopped();
}

void Drivetrain::turn() {
  double turned = 0;
  if (!stabilized_) {
    const double wheels = raw_ ? (left_wheel_ - right_wheel_) / track / to_radians : 0;
    turned = std::clamp(wheels + spin_deg_s_, -greatest_yaw_rate, greatest_yaw_rate) * step_s;
    yaw_deg_ = target_deg_ = aim_deg_ = wrap_360(yaw_deg_ + turned);
  } else if (rotate_left_deg_ != 0) {
    const double most = rotate_rate_ * step_s;
    turned = std::clamp(rotate_left_deg_, -most, most);
    rotate_left_deg_ -= turned;
    yaw_deg_ = rotate_left_deg_ == 0 ? aim_deg_ : wrap_360(yaw_deg_ + turned);
  } else if (yaw_deg_ != aim_deg_) {
    const double rate = fast_turn() ? fast_rotation_rate : rotation_rate_ * numbers_.turn_gain;
    const double most = rate * step_s;
    const double left = shortest_turn(yaw_deg_, aim_deg_);
    turned = std::clamp(left, -most, most);
    yaw_deg_ = std::abs(left - turned) < 1e-9 ? aim_deg_ : wrap_360(yaw_deg_ + turned);
  }
  yaw_rate_ = turned * control_rate;
  // The ball turns, but its momentum keeps its direction; the wheels have to bring it round.
  if (stabilized_ && turned != 0 && (forward_ != 0 || slip_ != 0)) {
    const auto& turn = turned_.of(turned);
    const double forward = forward_;
    forward_ = forward * turn.cosine() + slip_ * turn.sine();
    slip_ = slip_ * turn.cosine() - forward * turn.sine();
  }
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
    approach();
  }
  forward_acceleration_ = (forward_ - before) * control_rate;
}

/// Returns true if vector drive turns before it moves.
bool Drivetrain::turns_first() const {
  return vector_drive_ == Switch::On &&
         std::abs(forward_) <= full_speed * vector_drive_limit_ / greatest &&
         std::abs(shortest_turn(yaw_deg_, aim_deg_)) > 1;
}

/// Brings the speed closer to the ordered speed.
void Drivetrain::approach() {
  const double target = turns_first() ? 0 : aim_cm_s_;
  if (forward_ == target)
    return;
  const double rate = go_ == Go::Brake ? braking
                                       : std::clamp(std::abs(target - forward_) * gain_,
                                                    least_acceleration, acceleration);
  forward_ = toward(forward_, target, rate * step_s);
}

/// The shell grips the floor and loses its sideways speed.
void Drivetrain::lose_slip() {
  sideways_acceleration_ = forward_ * yaw_rate_ * to_radians;
  if (!stabilized_ && slip_ == 0)
    return;
  const double before = slip_;
  slip_ = toward(slip_, 0, numbers_.grip * step_s);
  sideways_acceleration_ = (slip_ - before) * control_rate;
}

void Drivetrain::lose_drift() {
  if (!drifts())
    return;
  const double drift = vm::length(drift_x_, drift_y_);
  const double left = std::max(0.0, drift - drift_friction * step_s) / drift;
  drift_x_ *= left;
  drift_y_ *= left;
}

} // namespace orb::vm
