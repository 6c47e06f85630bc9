#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "spec/robots.h"
#include "vm/body/ask.h"
#include "vm/body/battery.h"
#include "vm/body/drivetrain.h"
#include "vm/body/motion.h"
#include "vm/body/motion_sensors.h"
#include "vm/body/place.h"
#include "vm/body/remote_body.h"
#include "vm/body/shove.h"
#include "vm/body/walls.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

class Body;

/// Observes a body after each step in which it moved or tried to.
class StepObserver {
public:
  virtual ~StepObserver() = default;
  virtual void on_step(Instant at, const Body& body) = 0;
};

/// The ball as matter: set-points in, sensor values out. It knows no program, packet or client. It
/// moves in steps of the control system (400 Hz) on a grid that starts at power-on, and only while
/// something moves: advancing a body at rest costs nothing. docs/using/ball.md describes the model;
/// all its figures are rows of spec/ball.def. This class keeps time and place; drive, walls,
/// sensors and battery are separate parts in vm/body/. Large because it passes every set-point,
/// stimulus and sensor value through, so that callers need not know the parts.
class Body {
public:
  static constexpr Duration step = Duration{std::chrono::seconds{1}} / spec::ball::control_rate;

  /// `numbers`: driving characteristics; `start`: place and direction in its world at power-on;
  /// `robot`: determines the battery and the axes of the reported place.
  explicit Body(std::uint64_t seed, const spec::Driving& numbers = {}, const Placement& start = {},
                spec::Robot robot = spec::Robot::Sphero);

  /// Calls `observer` after every step; null: nobody. It must outlive the body.
  void observe(StepObserver* observer) { observer_ = observer; }

  // Time.
  /// Advances to `now`. Stops at a step with a blow, so that the caller sees its time and calls
  /// again. Returns the instant reached.
  Instant advance_to(Instant now);
  /// The next step in which something moves; `never` at rest.
  Instant next_step() const;
  /// Returns true if the body takes steps: it moves or tries to.
  bool moving() const { return felt_ ? robot_moves() : drive_.moving() || sensors_.falls(); }
  /// Returns true if its steps have no effect until the next request: it keeps moving, there is
  /// nothing to hit, and nobody observes it. Such a body may be advanced late.
  bool rolls_freely() const {
    return drive_.strives() && walls_.empty() && observer_ == nullptr && !felt_;
  }
  /// Returns true if the last step brought a blow not yet taken.
  bool struck() const { return impact_.has_value(); }
  /// Returns the blow of the last step, once.
  std::optional<Impact> take_impact();

  // A remote robot as the body.
  /// Sends set-points to a remote robot from now on and takes its samples as sensor values. The
  /// robot must outlive the body. Time then passes without steps.
  void become(RemoteBody& robot);
  /// Takes a sample of the robot, as of the instant reached.
  void feel(const Sample& sample);

  /// Powers on: at rest, heading 0, locator at 0,0, control system on. The world stays.
  void power_on();

  // Set-points.
  /// Applies a set-point. Refuses it if it has no effect: most have none while the control system
  /// is off.
  Outcome obey(const Motion& motion);
  void set_vector_drive(Switch vector_drive) { drive_.set_vector_drive(vector_drive); }
  /// The highest speed, 0 to 255, at which vector drive still turns before it moves.
  void set_vector_drive_limit(int speed) { drive_.set_vector_drive_limit(speed); }

  // Locator. Source: API §Configure Locator.
  void locate(double x_cm, double y_cm) { locator_ = {x_cm, y_cm}; }
  void set_yaw_tare(int tare_deg) { tare_deg_ = tare_deg; }
  void set_tare_correction(Switch correct_on_set_heading) {
    tare_correction_ = correct_on_set_heading;
  }

  // The world: stimuli.
  void add_wall(const Wall& wall) { walls_.add(wall, world_); }
  /// Applies a blow that moves the ball toward `heading_deg` of the world; strength 0..255.
  void push(int heading_deg, int strength);
  /// Applies contact with other balls. The caller reports each knock through feel_blow() and
  /// take_impact().
  void meet(const Shove& shove);
  /// Registers a blow of this velocity, cm/s in world axes. `speed` is the ball's own at that
  /// moment.
  void feel_blow(Point velocity, double speed) { strike(velocity, speed); }
  void shake() { sensors_.shake(now_); }
  /// Free fall for `time`, then a hard landing.
  void toss(Duration time) { sensors_.toss(now_, time); }
  void tilt(double pitch_deg, double roll_deg) { sensors_.tilt(pitch_deg, roll_deg); }
  /// Turns the ball by hand. It gives way only while stabilisation is off.
  void spin(double deg_per_s) { drive_.spin(deg_per_s); }
  void set_noise(Switch noise) { sensors_.set_noise(noise); }
  void set_battery(double volts) { battery_.set(volts, now_); }
  void set_charger(Switch charger) { battery_.set_charger(charger, now_); }

  // Sensors, as of the instant reached.
  bool stabilized() const { return drive_.stabilized(); }
  bool stopped() const { return felt_ ? !robot_moves() : drive_.stopped(); }
  int speed() const;                                  ///< 0..255
  double yaw_deg() const { return drive_.yaw_deg(); } ///< 0 <= yaw < 360
  double pitch_deg() const {                          ///< -90..90
    return felt_ ? felt_->pitch_deg : sensors_.pitch_deg(movement());
  }
  double roll_deg() const {
    return felt_ ? felt_->roll_deg : sensors_.roll_deg(now_);
  } ///< -180..180
  Vector3 acceleration_g() const {
    return felt_ ? felt_->acceleration_g : sensors_.acceleration_g(movement());
  }
  Vector3 rotation_deg_s() const {
    return felt_ ? felt_->rotation_deg_s : sensors_.rotation_deg_s(movement());
  }
  double acceleration_total_g() const;
  Quaternion attitude() const {
    return felt_ && felt_->attitude ? *felt_->attitude : sensors_.attitude(movement());
  }
  Pose pose() const;
  /// The place in pose().
  Point locator_cm() const { return locator_; }
  /// The same place, and the velocity, in the axes in which the robot reports them to clients.
  Point told_locator_cm() const { return in_axes(axes_, locator_); }
  Point told_velocity_cm_s() const {
    const auto velocity = velocity_cm_s();
    return in_axes(axes_, {velocity.x, velocity.y});
  }
  /// The pose in its world, where it started at its placement (by default at 0,0 facing +Y).
  /// Renaming heading or place does not change it.
  Pose world_pose() const;
  /// Its place in its world.
  Point place() const { return world_; }
  /// Its place in its world and its velocity.
  Mover mover() const;
  /// An upper bound of its present speed, cm/s, whatever it is ordered; only acceleration, pushes
  /// and blows can exceed it.
  double most_speed_cm_s() const { return drive_.most_speed_cm_s(); }
  Vector3 velocity_cm_s() const; ///< locator axes; z is 0
  double heading_setpoint_deg() const { return drive_.heading_setpoint_deg(); }
  int speed_setpoint() const { return drive_.speed_setpoint(); }
  /// Returns true if it was ordered to move: its target speed is not 0, or a motor is on.
  bool is_driven() const { return drive_.is_driven(); }
  /// Returns the roll that changes only the speed.
  Roll roll_at(int speed) const { return drive_.roll_at(speed); }
  double left_motor_cm_s() const { return drive_.left_motor_cm_s(); }
  double right_motor_cm_s() const { return drive_.right_motor_cm_s(); }
  int left_motor_power() const;  ///< -255..255
  int right_motor_power() const; ///< -255..255
  double battery_v() const { return battery_.volts(now_); }
  /// When the voltage falls to `volts` at rest; `never` while charging or if it is already lower.
  Instant battery_reaches(double volts) const { return battery_.reaches(volts, now_); }
  /// The voltage certainly stays above `volts` until then, however the ball drives.
  Instant battery_above_until(double volts) const { return battery_.above_until(volts, now_); }
  /// Distance rolled since construction.
  double way_cm() const { return rolled_cm_; }
  std::uint64_t rolled_cm() const { return static_cast<std::uint64_t>(rolled_cm_); }
  bool charging() const { return battery_.charging(); }

private:
  Outcome obey_one(const SetHeading& name);
  template <class Setpoint>
  Outcome obey_one(const Setpoint& setpoint) {
    return drive_.obey(setpoint);
  }
  double speed_cm_s() const;
  bool robot_moves() const;
  void tell_robot(const Motion& motion);
  Movement movement() const;
  bool goes_straight_on() const;
  void go_straight_on(Duration::rep steps);
  void single_step();
  void travel();
  void move_to(Point place, double way_cm, double speed);
  void strike(Point velocity, double speed);
  void move_aside(Point shift);

  Instant now_{};
  StepObserver* observer_ = nullptr;
  Drivetrain drive_;
  Walls walls_;
  MotionSensors sensors_;
  Battery battery_;
  spec::Axes axes_;

  double tare_deg_ = 0; ///< locator direction = yaw + tare
  Switch tare_correction_ = Switch::On;
  Point world_;
  Point locator_;
  double rolled_cm_ = 0;
  std::optional<Impact> impact_;

  RemoteBody* robot_ = nullptr;
  std::optional<Sample> felt_; ///< the remote robot's last sample, if there is a robot
};

} // namespace orb::vm
