#pragma once

#include "spec/ball.h"
#include "vm/body/angles.h"
#include "vm/body/ask.h"
#include "vm/body/motion.h"
#include "vm/body/place.h"

#include <array>
#include <cstdint>

namespace orb::vm {

/// Velocity and speed over ground.
struct Velocity {
  double vx = 0; ///< cm/s, in world axes
  double vy = 0;
  double speed = 0;
};

/// Sine and cosine of an angle. Keeps the last result, because headings and turns repeat.
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

/// Motors, wheels and control system: set-points in, heading and speed out, one step of the control
/// system at a time. It knows neither place nor walls. Directions are degrees clockwise from +Y,
/// speeds cm/s. Large because each kind of set-point and each quantity of the motion has its own
/// member.
class Drivetrain {
public:
  explicit Drivetrain(const spec::Driving& numbers = {})
      : numbers_(numbers), gain_(1 / numbers.speed_lag) {}

  /// Resets to rest, heading 0, control system on. The direction it faces in the world does not
  /// change.
  void power_on();

  /// Sets the world direction of heading 0. To be called before the first step.
  void start_facing(double world_deg) { world_offset_deg_ = world_deg; }

  // Set-points. Refused if they have no effect: most have none while the control system is off.
  Outcome obey(const Roll& roll);
  Outcome obey(const Rotate& turn);
  Outcome obey(const Motors& motors);
  Outcome obey(const SetSpeed& change);
  Outcome obey(Stabilization mode);
  Outcome obey(const RotationRate& rate);
  Outcome obey(const Stop&);
  /// Renames the present heading. Returns the angle in degrees by which the names have turned.
  double rename_heading(int heading_deg);
  void set_vector_drive(Switch vector_drive) { vector_drive_ = vector_drive; }
  /// The highest speed, 0 to 255, at which vector drive still turns before it moves.
  void set_vector_drive_limit(int speed) { vector_drive_limit_ = speed; }
  /// Turns it by hand. It gives way only while stabilisation is off.
  void spin(double deg_per_s) { spin_deg_s_ = deg_per_s; }
  /// Adds `velocity`, in world axes.
  void push(Point velocity);
  /// Replaces all motion by `velocity`, in world axes: a wall leaves nothing else.
  void bounce(Point velocity);

  /// Adds `change`, in world axes, for contact without a blow: the wheels keep driving at the
  /// changed speed, and a ball at rest drifts.
  void press(Point change);

  /// Takes one step of the control system: turns, accelerates or brakes.
  void step();
  /// Sets the yaw after somebody else turned it; the set-point stays.
  void face(double yaw_deg) { yaw_deg_ = yaw_deg; }
  /// Clears rates and accelerations, because no step is taken.
  void rest() { yaw_rate_ = forward_acceleration_ = sideways_acceleration_ = 0; }
  /// Returns true if a step changes anything: it moves or tries to.
  bool moving() const {
    return target_speed_ != 0 || waiting_ != 0 || aim_cm_s_ != 0 || forward_ != 0 || slip_ != 0 ||
           drifts() || rotate_left_deg_ != 0 || left_wheel_ != 0 || right_wheel_ != 0 ||
           (stabilized_ && aim_deg_ != yaw_deg_) || (!stabilized_ && spin_deg_s_ != 0) ||
           (raw_ && (left_.power != 0 || right_.power != 0));
  }
  /// Returns true if it goes straight ahead, so that steps change only place and speed.
  bool straight() const {
    return stabilized_ && waiting_ == 0 && yaw_deg_ == aim_deg_ && rotate_left_deg_ == 0 &&
           slip_ == 0 && !drifts();
  }
  /// Takes a step while straight(); the result is exactly that of step().
  void step_straight() {
    yaw_rate_ = sideways_acceleration_ = 0;
    const double before = forward_;
    approach();
    forward_acceleration_ = (forward_ - before) * spec::ball::control_rate;
  }
  bool rolls() const { return forward_ != 0 || slip_ != 0 || drifts(); }
  bool strives() const { return target_speed_ != 0; }
  /// Returns true if it was ordered to move: its target speed is not 0, or a motor is on.
  bool is_driven() const { return strives() || is_on(left_) || is_on(right_); }
  bool stopped() const;

  Velocity course() const {
    const auto own = own_velocity_cm_s(yaw_deg_ + world_offset_deg_);
    if (slip_ == 0 && !drifts())
      return {own.x, own.y, std::abs(forward_)};
    const double vx = own.x + drift_x_;
    const double vy = own.y + drift_y_;
    return {vx, vy, std::sqrt(vx * vx + vy * vy)};
  }
  /// Its speed if wheels and drift pulled the same way: an upper bound that only acceleration,
  /// pushes and blows can exceed.
  double most_speed_cm_s() const {
    // Not std::hypot(): it is exact to the last bit and takes five times as long.
    return std::sqrt(forward_ * forward_ + slip_ * slip_) +
           std::sqrt(drift_x_ * drift_x_ + drift_y_ * drift_y_);
  }
  bool stabilized() const { return stabilized_; }
  double yaw_deg() const { return yaw_deg_; } ///< 0 <= yaw < 360
  double yaw_rate_deg_s() const { return yaw_rate_; }
  double world_offset_deg() const { return world_offset_deg_; } ///< world direction = yaw + offset
  double forward_acceleration_cm_s2() const { return forward_acceleration_; }
  double sideways_acceleration_cm_s2() const { return sideways_acceleration_; } ///< to the right
  /// Velocity by wheels and momentum, without drift, in axes where the heading is `way_deg`.
  Point own_velocity_cm_s(double way_deg) const {
    const auto& way = way_.of(way_deg);
    return {forward_ * way.sine() + slip_ * way.cosine(),
            forward_ * way.cosine() - slip_ * way.sine()};
  }
  Point drift_cm_s() const { return {drift_x_, drift_y_}; } ///< due to pushes and bounces
  double heading_setpoint_deg() const { return target_deg_; }
  int speed_setpoint() const { return target_speed_; }
  /// Returns the roll that changes only the speed.
  Roll roll_at(int speed) const;
  double left_motor_cm_s() const { return raw_ ? left_wheel_ : forward_; }
  double right_motor_cm_s() const { return raw_ ? right_wheel_ : forward_; }

private:
  /// An order on its way to the motors.
  struct Order {
    static constexpr std::int16_t same_heading = -1;
    std::uint32_t due = 0; ///< in `steps_`
    std::int16_t heading_deg = same_heading;
    std::uint8_t speed = 0;
    Go go = Go::Brake;
    Way way = Way::Ahead;
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
  bool raw_ = false; ///< driven by raw motor values (Motors)
  Switch vector_drive_ = Switch::Off;
  int vector_drive_limit_ = spec::ball::default_vector_drive_limit;
  int target_speed_ = 0; ///< of the last order
  double target_deg_ = 0;
  Go go_ = Go::Brake; ///< what the motors do now: an order reaches them after the dead time
  double aim_cm_s_ = 0;
  double aim_deg_ = 0;
  /// A ring. Orders within one step are merged, so there is at most one per step of dead time.
  std::array<Order, spec::most_dead_steps + 1> orders_{};
  std::size_t first_ = 0;
  std::size_t waiting_ = 0;
  std::uint32_t steps_ = 0;
  double rotation_rate_ = spec::ball::default_rotation_rate;
  double rotate_left_deg_ = 0; ///< rest of a Rotate
  double rotate_rate_ = 0;
  Motor left_;
  Motor right_;
  double yaw_deg_ = 0;
  double world_offset_deg_ = 0;
  double forward_ = 0;
  double slip_ = 0; ///< to the right: sideways speed that momentum keeps after a turn
  double left_wheel_ = 0;
  double right_wheel_ = 0;
  double drift_x_ = 0; ///< in world axes
  double drift_y_ = 0;
  mutable Direction way_; ///< cached by own_velocity_cm_s()
  Direction turned_;      ///< cached by turn()
  double yaw_rate_ = 0;
  double forward_acceleration_ = 0;
  double sideways_acceleration_ = 0;
  double spin_deg_s_ = 0;
  spec::Driving numbers_;
  double gain_; ///< rate of approach to the ordered speed, per second
};

} // namespace orb::vm
