#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "spec/robots.h"
#include "vm/body/ask.h"
#include "vm/body/battery.h"
#include "vm/body/drivetrain.h"
#include "vm/body/elsewhere.h"
#include "vm/body/motion.h"
#include "vm/body/motion_sensors.h"
#include "vm/body/place.h"
#include "vm/body/shove.h"
#include "vm/body/walls.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

class Body;

/// Sees a body after each step in which it moved, or strove to.
class StepObserver {
public:
  virtual ~StepObserver() = default;
  virtual void on_step(Instant at, const Body& body) = 0;
};

/// The ball as matter: set-points in, sensor values out. It knows no program, no packet and no
/// client. It moves in steps of the control system (400 Hz) on a grid that starts at its power-on,
/// and only while something moves: at rest, advancing costs nothing. docs/ball.md lists the model;
/// every figure of it is a row of spec/ball.def. Here are time and place; what moves it, what it
/// runs into, what it feels and what feeds it are parts of their own in vm/body/.
class Body {
public:
  static constexpr Duration step = Duration{std::chrono::seconds{1}} / spec::ball::control_rate;

  /// `numbers`: how this robot drives; `start`: where it wakes up in its world.
  /// `robot`: whose battery it has, and whose axes it tells its place in.
  explicit Body(std::uint64_t seed, const spec::Driving& numbers = {}, const Placement& start = {},
                spec::Robot robot = spec::Robot::Sphero);

  /// `observer` sees every step; null: nobody. It must outlive the body.
  void observe(StepObserver* observer) { observer_ = observer; }

  // Time.
  /// Moves on to `now`. Stops at the step in which a blow occurs, so that the caller can tell its
  /// time; it is called again then. Returns the instant reached.
  Instant advance_to(Instant now);
  /// The next step in which something moves; `never` at rest.
  Instant next_step() const;
  /// Whether it takes steps: it moves, or strives to.
  bool moving() const { return felt_ ? robot_moves() : drive_.moving() || sensors_.falls(); }
  /// Whether its steps can lead to nothing until somebody asks something of it: it goes on moving,
  /// there is nothing to run into, and nobody watches. Then it may be advanced late.
  bool rolls_freely() const {
    return drive_.strives() && walls_.empty() && observer_ == nullptr && !felt_;
  }
  /// Whether the last step brought a blow that nobody has taken.
  bool struck() const { return impact_.has_value(); }
  /// The blow of the last step, once.
  std::optional<Impact> take_impact();

  // Elsewhere.
  /// From now on a robot is this body: it gets the set-points, and sensors are what it says. It
  /// must outlive the body. Time passes without steps then.
  void become(Elsewhere& robot);
  /// The robot has said this of itself, as of the instant reached.
  void feel(const Sample& sample);

  /// Wakes up: at rest, heading 0, locator at 0,0, the control system on. The world stays.
  void power_on();

  // Set-points.
  /// Refused where it has no effect: while the control system is off most have none.
  Outcome obey(const Motion& motion);
  void set_vector_drive(Switch vector_drive) { drive_.set_vector_drive(vector_drive); }
  /// The speed, 0 to 255, up to which vector drive turns before it moves.
  void set_vector_drive_limit(int speed) { drive_.set_vector_drive_limit(speed); }

  // Locator (Source: API §Configure Locator).
  void locate(double x_cm, double y_cm) { locator_ = {x_cm, y_cm}; }
  void set_yaw_tare(int tare_deg) { tare_deg_ = tare_deg; }
  void set_tare_correction(Switch correct_on_set_heading) {
    tare_correction_ = correct_on_set_heading;
  }

  // The world: stimuli.
  void add_wall(const Wall& wall) { walls_.add(wall, world_); }
  /// A blow that sets the ball moving toward `heading_deg` of the world; strength 0..255.
  void push(int heading_deg, int strength);
  /// Other balls press on it, or have run into it. Each knock is felt when it comes: take_impact().
  void meet(const Shove& shove);
  /// It feels a blow of this velocity, cm/s in world axes, and goes at `speed` then.
  void feel_blow(Point velocity, double speed) { strike(velocity, speed); }
  void shake() { sensors_.shake(now_); }
  /// Free fall for `time`, then a hard landing.
  void toss(Duration time) { sensors_.toss(now_, time); }
  void tilt(double pitch_deg, double roll_deg) { sensors_.tilt(pitch_deg, roll_deg); }
  /// A hand that turns the ball; the ball yields only while stabilisation is off.
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
  /// The place of pose().
  Point locator_cm() const { return locator_; }
  /// The same, and the velocity, as the robot tells clients.
  Point told_locator_cm() const { return in_axes(axes_, locator_); }
  Point told_velocity_cm_s() const {
    const auto velocity = velocity_cm_s();
    return in_axes(axes_, {velocity.x, velocity.y});
  }
  /// The same in its world, in which it woke up at its placement (0,0 facing +Y where it has none),
  /// whatever the program calls its place and its heading since.
  Pose world_pose() const;
  /// Where it is in its world.
  Point place() const { return world_; }
  /// The same, and where it goes.
  Mover mover() const;
  /// No way of it to be faster at once, whatever it is ordered, cm/s; only time, pushes and blows.
  double most_speed_cm_s() const { return drive_.most_speed_cm_s(); }
  Vector3 velocity_cm_s() const; ///< locator axes; z is 0
  double heading_setpoint_deg() const { return drive_.heading_setpoint_deg(); }
  int speed_setpoint() const { return drive_.speed_setpoint(); }
  /// Whether it is told to move: a speed is ordered, or a motor is on.
  bool is_driven() const { return drive_.is_driven(); }
  /// The roll that changes nothing but the speed.
  Roll roll_at(int speed) const { return drive_.roll_at(speed); }
  double left_motor_cm_s() const { return drive_.left_motor_cm_s(); }
  double right_motor_cm_s() const { return drive_.right_motor_cm_s(); }
  int left_motor_power() const;  ///< -255..255
  int right_motor_power() const; ///< -255..255
  double battery_v() const { return battery_.volts(now_); }
  /// When the voltage falls to `volts` at rest; `never` while charging or below already.
  Instant battery_reaches(double volts) const { return battery_.reaches(volts, now_); }
  /// Until when it is above that for sure, however the ball drives.
  Instant battery_above_until(double volts) const { return battery_.above_until(volts, now_); }
  /// The length of its way since it was made.
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

  Elsewhere* robot_ = nullptr;
  std::optional<Sample> felt_; ///< of the robot, where there is one
};

} // namespace orb::vm
