#pragma once

#include "spec/ball.h"
#include "vm/ask.h"
#include "vm/body/motion.h"
#include "vm/body/place.h"

namespace orb::vm {

/// Where the ball goes, with what it was computed from: straight on, it is the same every step.
struct Course {
  double forward = 0;
  double heading_deg = 0; ///< of the world
  double drift_x = 0;
  double drift_y = 0;
  double vx = 0; ///< cm/s, in world axes
  double vy = 0;
  double speed = 0;
};

/// Motors, wheels and the control system: set-points in, heading and speed out, a step of the
/// control system at a time. It knows neither a place nor a wall. Directions in degrees, clockwise
/// from +Y; speeds in cm/s.
class Drivetrain {
public:
  /// At rest, heading 0 wherever it points, the control system on. What it faces in the world does
  /// not change.
  void power_on();

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

  /// A step of the control system: turns, speeds up or slows down.
  void step();
  /// No step is taken: nothing accelerates.
  void rest() { yaw_rate_ = forward_acceleration_ = 0; }
  /// Whether a step changes anything: it moves, or strives to.
  bool moving() const {
    return target_speed_ != 0 || forward_ != 0 || drifts() || rotate_left_deg_ != 0 ||
           left_wheel_ != 0 || right_wheel_ != 0 || (stabilized_ && target_deg_ != yaw_deg_) ||
           (!stabilized_ && spin_deg_s_ != 0) || (raw_ && (left_.power != 0 || right_.power != 0));
  }
  /// Whether the next step changes nothing but its place.
  bool steady() const {
    return stabilized_ && yaw_deg_ == target_deg_ && rotate_left_deg_ == 0 &&
           forward_ == commanded_cm_s() && !drifts();
  }
  bool rolls() const { return forward_ != 0 || drifts(); }
  bool strives() const { return target_speed_ != 0; }
  bool stopped() const;

  const Course& course() const;
  bool stabilized() const { return stabilized_; }
  double yaw_deg() const { return yaw_deg_; } ///< 0 <= yaw < 360
  double yaw_rate_deg_s() const { return yaw_rate_; }
  double world_offset_deg() const { return world_offset_deg_; } ///< world direction = yaw + offset
  double forward_cm_s() const { return forward_; }
  double forward_acceleration_cm_s2() const { return forward_acceleration_; }
  Point drift_cm_s() const { return {drift_x_, drift_y_}; } ///< what pushes and bounces add
  double heading_setpoint_deg() const { return target_deg_; }
  int speed_setpoint() const { return target_speed_; }
  /// The roll that changes nothing but the speed.
  Roll roll_at(int speed) const;
  double left_motor_cm_s() const { return raw_ ? left_wheel_ : forward_; }
  double right_motor_cm_s() const { return raw_ ? right_wheel_ : forward_; }

private:
  double commanded_cm_s() const;
  bool drifts() const { return drift_x_ != 0 || drift_y_ != 0; }
  bool fast_turn() const;
  void turn();
  void drive();
  void lose_drift();

  bool stabilized_ = true;
  bool raw_ = false; ///< the motors are driven by Motors
  Switch vector_drive_ = Switch::Off;
  int vector_drive_limit_ = spec::ball::default_vector_drive_limit;
  Go go_ = Go::Brake;
  int target_speed_ = 0;
  double target_deg_ = 0;
  double rotation_rate_ = spec::ball::default_rotation_rate;
  double rotate_left_deg_ = 0; ///< what is left of a Rotate
  double rotate_rate_ = 0;
  Motor left_;
  Motor right_;
  double yaw_deg_ = 0;
  double world_offset_deg_ = 0;
  double forward_ = 0;
  double left_wheel_ = 0;
  double right_wheel_ = 0;
  double drift_x_ = 0; ///< in world axes
  double drift_y_ = 0;
  mutable Course course_; ///< of the last call of course()
  double yaw_rate_ = 0;
  double forward_acceleration_ = 0;
  double spin_deg_s_ = 0;
};

} // namespace orb::vm
