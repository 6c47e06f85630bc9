#pragma once

#include "spec/ball.h"
#include "vm/body/angles.h"
#include "vm/body/ask.h"
#include "vm/body/motion.h"
#include "vm/body/place.h"

#include <array>
#include <cstdint>

namespace orb::vm {

/// Where the ball goes.
struct Course {
  double vx = 0; ///< cm/s, in world axes
  double vy = 0;
  double speed = 0;
};

/// Sine and cosine of an angle. Headings stay and turns are alike, so the last answer is kept.
class Direction {
public:
  const Direction& of(double degrees) {
    if (degrees != degrees_) {
      degrees_ = degrees;
      sine_ = vm::sine(degrees * to_radians);
      cosine_ = vm::cosine(degrees * to_radians);
    }
    return *this;
  }
  double sine() const { return sine_; }
  double cosine() const { return cosine_; }

private:
  double degrees_ = 0;
  double sine_ = 0;
  double cosine_ = 1;
};

/// Motors, wheels and the control system: set-points in, heading and speed out, a step of the
/// control system at a time. It knows neither a place nor a wall. Directions in degrees, clockwise
/// from +Y; speeds in cm/s.
class Drivetrain {
public:
  explicit Drivetrain(const spec::Driving& numbers = {})
      : numbers_(numbers), gain_(1 / numbers.speed_lag) {}

  /// At rest, heading 0 wherever it points, the control system on. What it faces in the world does
  /// not change.
  void power_on();

  /// Heading 0 points there in the world; before the first step.
  void start_facing(double world_deg) { world_offset_deg_ = world_deg; }

  // Set-points. Refused where they have no effect: while the control system is off most have none.
  Outcome obey(const Roll& roll);
  Outcome obey(const Rotate& turn);
  Outcome obey(const Motors& motors);
  Outcome obey(const SetSpeed& change);
  Outcome obey(Stabilization mode);
  Outcome obey(const RotationRate& rate);
  Outcome obey(const Stop&);
  /// Renames the present heading. Returns by how many degrees the names have turned.
  double rename_heading(int heading_deg);
  void set_vector_drive(Switch vector_drive) { vector_drive_ = vector_drive; }
  /// The speed, 0 to 255, up to which vector drive turns before it moves.
  void set_vector_drive_limit(int speed) { vector_drive_limit_ = speed; }
  /// A hand that turns the ball; it yields only while stabilisation is off.
  void spin(double deg_per_s) { spin_deg_s_ = deg_per_s; }
  /// A push adds `velocity`, in world axes.
  void push(Point velocity);
  /// A wall leaves nothing but `velocity`, in world axes.
  void bounce(Point velocity);

  /// Something that touches it, and is no blow, changes its velocity by `change`, in world axes:
  /// the wheels go on with what is left, and a ball that they do not drive drifts.
  void press(Point change);

  /// A step of the control system: turns, speeds up or slows down.
  void step();
  /// It faces there, because somebody else turned it; the set-point stays.
  void face(double yaw_deg) { yaw_deg_ = yaw_deg; }
  /// No step is taken: nothing accelerates.
  void rest() { yaw_rate_ = forward_acceleration_ = sideways_acceleration_ = 0; }
  /// Whether a step changes anything: it moves, or strives to.
  bool moving() const {
    return target_speed_ != 0 || waiting_ != 0 || aim_cm_s_ != 0 || forward_ != 0 || slip_ != 0 ||
           drifts() || rotate_left_deg_ != 0 || left_wheel_ != 0 || right_wheel_ != 0 ||
           (stabilized_ && aim_deg_ != yaw_deg_) || (!stabilized_ && spin_deg_s_ != 0) ||
           (raw_ && (left_.power != 0 || right_.power != 0));
  }
  /// Whether it goes straight ahead, and steps change nothing but its place and its speed.
  bool straight() const {
    return stabilized_ && waiting_ == 0 && yaw_deg_ == aim_deg_ && rotate_left_deg_ == 0 &&
           slip_ == 0 && !drifts();
  }
  /// A step while it is straight(): exactly what step() does then.
  void step_straight() {
    yaw_rate_ = sideways_acceleration_ = 0;
    const double before = forward_;
    approach();
    forward_acceleration_ = (forward_ - before) * spec::ball::control_rate;
  }
  bool rolls() const { return forward_ != 0 || slip_ != 0 || drifts(); }
  bool strives() const { return target_speed_ != 0; }
  /// Whether it is told to move: a speed is ordered, or a motor is on.
  bool is_driven() const { return strives() || is_on(left_) || is_on(right_); }
  bool stopped() const;

  Course course() const {
    const auto own = own_velocity_cm_s(yaw_deg_ + world_offset_deg_);
    if (slip_ == 0 && !drifts())
      return {own.x, own.y, std::abs(forward_)};
    const double vx = own.x + drift_x_;
    const double vy = own.y + drift_y_;
    return {vx, vy, std::sqrt(vx * vx + vy * vy)};
  }
  /// Its speed where wheels and drift pull the same way: only acceleration, pushes and blows lead
  /// beyond it.
  double most_speed_cm_s() const {
    // Not std::hypot(), which takes five times as long to be exact in the last bit.
    return std::sqrt(forward_ * forward_ + slip_ * slip_) +
           std::sqrt(drift_x_ * drift_x_ + drift_y_ * drift_y_);
  }
  bool stabilized() const { return stabilized_; }
  double yaw_deg() const { return yaw_deg_; } ///< 0 <= yaw < 360
  double yaw_rate_deg_s() const { return yaw_rate_; }
  double world_offset_deg() const { return world_offset_deg_; } ///< world direction = yaw + offset
  double forward_acceleration_cm_s2() const { return forward_acceleration_; }
  double sideways_acceleration_cm_s2() const { return sideways_acceleration_; } ///< to the right
  /// What the wheels and its momentum make of it, for somebody who calls the heading `way_deg`.
  Point own_velocity_cm_s(double way_deg) const {
    const auto& way = way_.of(way_deg);
    return {forward_ * way.sine() + slip_ * way.cosine(),
            forward_ * way.cosine() - slip_ * way.sine()};
  }
  Point drift_cm_s() const { return {drift_x_, drift_y_}; } ///< what pushes and bounces add
  double heading_setpoint_deg() const { return target_deg_; }
  int speed_setpoint() const { return target_speed_; }
  /// The roll that changes nothing but the speed.
  Roll roll_at(int speed) const;
  double left_motor_cm_s() const { return raw_ ? left_wheel_ : forward_; }
  double right_motor_cm_s() const { return raw_ ? right_wheel_ : forward_; }

private:
  /// An order on its way to the motors.
  struct Order {
    static constexpr std::int16_t same_heading = -1;
    std::uint32_t due = 0; ///< of `steps_`
    std::int16_t heading_deg = same_heading;
    std::uint8_t speed = 0;
    Go go = Go::Brake;
  };
  void give(Order order);
  void take_orders();
  void forget_headings();
  void forget_orders();
  Order& waiting(std::size_t place) { return orders_[(first_ + place) % orders_.size()]; }
  bool drifts() const { return drift_x_ != 0 || drift_y_ != 0; }
  bool fast_turn() const;
  bool turns_first() const;
  void approach();
  void turn();
  void drive();
  void lose_slip();
  void lose_drift();

  bool stabilized_ = true;
  bool raw_ = false; ///< the motors are driven by Motors
  Switch vector_drive_ = Switch::Off;
  int vector_drive_limit_ = spec::ball::default_vector_drive_limit;
  int target_speed_ = 0; ///< as ordered last
  double target_deg_ = 0;
  Go go_ = Go::Brake; ///< what the motors strive for: the order of a dead time ago
  double aim_cm_s_ = 0;
  double aim_deg_ = 0;
  /// A ring: orders between two steps become one, so there are no more than steps of dead time.
  std::array<Order, spec::most_dead_steps + 1> orders_{};
  std::size_t first_ = 0;
  std::size_t waiting_ = 0;
  std::uint32_t steps_ = 0;
  double rotation_rate_ = spec::ball::default_rotation_rate;
  double rotate_left_deg_ = 0; ///< what is left of a Rotate
  double rotate_rate_ = 0;
  Motor left_;
  Motor right_;
  double yaw_deg_ = 0;
  double world_offset_deg_ = 0;
  double forward_ = 0;
  double slip_ = 0; ///< to the right: the way it still goes while it already points elsewhere
  double left_wheel_ = 0;
  double right_wheel_ = 0;
  double drift_x_ = 0; ///< in world axes
  double drift_y_ = 0;
  mutable Direction way_; ///< of the last call of own_velocity_cm_s()
  Direction turned_;      ///< in the last step
  double yaw_rate_ = 0;
  double forward_acceleration_ = 0;
  double sideways_acceleration_ = 0;
  double spin_deg_s_ = 0;
  spec::Driving numbers_;
  double gain_; ///< of the approach to an ordered speed, per second
};

} // namespace orb::vm
