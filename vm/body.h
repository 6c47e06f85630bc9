#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "vm/ask.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace orb::vm {

struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend constexpr bool operator==(Color, Color) = default;
};

/// The third value of a roll (Source: LL §Roll Command Parameters).
enum class Go : std::uint8_t {
  Brake = 0,   ///< optimal braking to a stop
  Drive = 1,   ///< normal driving
  FastTurn = 2 ///< turn at the fast rate at any speed
};

struct Roll {
  int heading_deg = 0; ///< 0..359
  int speed = 0;       ///< 0..255
  Go go = Go::Drive;

  friend constexpr bool operator==(const Roll&, const Roll&) = default;
};

/// What a motor does (Source: API §Set Raw Motor Values).
enum class MotorMode : std::uint8_t { Off = 0, Forward = 1, Reverse = 2, Brake = 3, Ignore = 4 };

struct Motor {
  MotorMode mode = MotorMode::Off;
  int power = 0; ///< 0..255
};

struct Motors {
  Motor left;
  Motor right;
};

/// The control system. `OnAndReset` also takes the present heading as the set-point.
enum class Stabilization : std::uint8_t { Off = 0, OnAndReset = 1, On = 2 };

/// Positive to the right; more than one turn is possible.
struct Rotate {
  int angle_deg = 0;
  Duration time{};
};

/// Renames the present heading (Source: API §Set Heading); the locator follows its own rule.
struct SetHeading {
  int heading_deg = 0;
};

/// Another speed along the present heading (Source: macro 25h).
struct SetSpeed {
  int speed = 0; ///< 0..255
};

/// The rate of an ordinary turn.
struct RotationRate {
  double deg_per_s = 0;
};

/// Brakes to a stop and keeps the heading; motors that were set go off.
struct Stop {};

/// What clients, programs and macros ask of the control system.
using Motion =
    std::variant<Roll, Rotate, Motors, SetHeading, SetSpeed, Stabilization, RotationRate, Stop>;

enum class Switch : std::uint8_t { Off, On };

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct Quaternion {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
};

/// Where the ball is: locator coordinates, heading as commanded, speed over ground.
struct Pose {
  double x_cm = 0;
  double y_cm = 0;
  double heading_deg = 0;
  double speed_cm_s = 0;
};

/// A place in centimetres; where nothing else is said, of the world in which the ball woke up at
/// 0,0 facing +Y.
struct Point {
  double x = 0;
  double y = 0;

  friend constexpr bool operator==(Point, Point) = default;
};

/// A straight wall: endless at `x=` or `y=`, or between two points.
struct Wall {
  enum class Axis : std::uint8_t { X, Y, None };
  Axis axis = Axis::X;
  double at_cm = 0; ///< of an endless one
  Point from{};     ///< of one along no axis
  Point to{};

  static constexpr Wall between(Point from, Point to) { return {Axis::None, 0, from, to}; }
  friend constexpr bool operator==(const Wall&, const Wall&) = default;
};

/// `x=70`, or `-30,50 to 30,50` of a wall between two points.
std::string to_string(const Wall& wall);

/// The point of a wall between two points that is nearest to `place`.
Point nearest_point(const Wall& wall, Point place);

/// A blow as the accelerometer sees it: positive y is a blow on the front, positive x one on the
/// right (Source: LL §Collision Detection).
struct Impact {
  double x_power = 0; ///< compared with the thresholds of the X axis
  double y_power = 0;
  int speed = 0;            ///< 0..255 at the moment of the blow
  std::optional<Wall> wall; ///< what it ran into; nothing for a push
};

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
/// every figure of it is a constant at the top of body.cpp.
class Body {
public:
  static constexpr Duration step = Duration{std::chrono::seconds{1}} / spec::ball::control_rate;

  explicit Body(std::uint64_t seed);

  /// `observer` sees every step; null: nobody. It must outlive the body.
  void observe(StepObserver* observer) { observer_ = observer; }

  // Time.
  /// Moves on to `now`. Stops at the step in which a blow occurs, so that the caller can tell its
  /// time; it is called again then. Returns the instant reached.
  Instant advance_to(Instant now);
  /// The next step in which something moves; `never` at rest.
  Instant next_step() const;
  /// Whether it takes steps: it moves, or strives to.
  bool moving() const {
    return target_speed_ != 0 || forward_ != 0 || drifts() || rotate_left_deg_ != 0 ||
           left_wheel_ != 0 || right_wheel_ != 0 || (stabilized_ && target_deg_ != yaw_deg_) ||
           (!stabilized_ && spin_deg_s_ != 0) ||
           (raw_ && (left_.power != 0 || right_.power != 0)) || landing_;
  }
  /// Whether its steps can lead to nothing until somebody asks something of it: it goes on moving,
  /// there is nothing to run into, and nobody watches. Then it may be advanced late.
  bool rolls_freely() const {
    return target_speed_ != 0 && walls_.empty() && segments_.empty() && observer_ == nullptr;
  }
  /// The blow of the last step, once.
  std::optional<Impact> take_impact();

  /// Wakes up: at rest, heading 0, locator at 0,0, the control system on. The world stays.
  void power_on();

  // Set-points.
  /// Refused where it has no effect: while the control system is off most have none.
  Outcome obey(const Motion& motion);
  void set_vector_drive(Switch vector_drive);
  /// The speed, 0 to 255, up to which vector drive turns before it moves.
  void set_vector_drive_limit(int speed) { vector_drive_limit_ = speed; }

  // Locator (Source: API §Configure Locator).
  void locate(double x_cm, double y_cm);
  void set_yaw_tare(int tare_deg);
  void set_tare_correction(Switch correct_on_set_heading);

  // The world: stimuli.
  void add_wall(const Wall& wall);
  /// A blow that sets the ball moving toward `heading_deg` of the world; strength 0..255.
  void push(int heading_deg, int strength);
  void shake();
  /// Free fall for `time`, then a hard landing.
  void toss(Duration time);
  void tilt(double pitch_deg, double roll_deg);
  /// A hand that turns the ball; the ball yields only while stabilisation is off.
  void spin(double deg_per_s);
  void set_noise(Switch noise) { noise_ = noise; }
  void set_battery(double volts);
  void set_charger(Switch charger);

  // Sensors, as of the instant reached.
  bool stabilized() const { return stabilized_; }
  bool stopped() const;
  int speed() const;        ///< 0..255
  double yaw_deg() const;   ///< 0 <= yaw < 360
  double pitch_deg() const; ///< -90..90
  double roll_deg() const;  ///< -180..180
  Vector3 acceleration_g() const;
  Vector3 rotation_deg_s() const;
  double acceleration_total_g() const;
  Quaternion attitude() const;
  Pose pose() const;
  /// The place of pose().
  Point locator_cm() const { return {locator_x_, locator_y_}; }
  /// The same in the world in which the ball woke up at 0,0 facing +Y, whatever the program calls
  /// its place and its heading since.
  Pose world_pose() const;
  Vector3 velocity_cm_s() const; ///< locator axes; z is 0
  double heading_setpoint_deg() const { return target_deg_; }
  int speed_setpoint() const { return target_speed_; }
  /// The roll that changes nothing but the speed.
  Roll roll_at(int speed) const;
  double left_motor_cm_s() const;
  double right_motor_cm_s() const;
  int left_motor_power() const;  ///< -255..255
  int right_motor_power() const; ///< -255..255
  double battery_v() const;
  /// When the voltage falls to `volts` at rest; `never` while charging or below already.
  Instant battery_reaches(double volts) const;
  /// Until when it is above that for sure, however the ball drives.
  Instant battery_above_until(double volts) const;
  /// The length of its way since it was made.
  double way_cm() const { return rolled_cm_; }
  std::uint64_t rolled_cm() const { return static_cast<std::uint64_t>(rolled_cm_); }
  bool charging() const { return charger_ == Switch::On; }

private:
  Outcome obey_one(const Roll& roll);
  Outcome obey_one(const Rotate& turn);
  Outcome obey_one(const Motors& motors);
  Outcome obey_one(const SetHeading& name);
  Outcome obey_one(const SetSpeed& change);
  Outcome obey_one(Stabilization mode);
  Outcome obey_one(const RotationRate& rate);
  Outcome obey_one(const Stop&);
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
  const Course& course() const;
  double speed_cm_s() const;
  double commanded_cm_s() const;
  bool drifts() const { return drift_x_ != 0 || drift_y_ != 0; }
  bool fast_turn() const;
  bool goes_straight_on() const;
  void go_straight_on(Duration::rep steps);
  void single_step();
  void turn();
  void drive();
  void travel();
  void move_to(double x, double y, double way_cm, double speed);
  void hit_walls(double& new_x, double& new_y, double vx, double vy);
  void hit_segments(Point& place);
  bool push_out(Point& place);
  void bounce(const Wall& wall, Point normal);
  void strike(double vx, double vy);
  double noise(std::uint32_t channel) const;

  Instant now_{};
  std::uint64_t seed_;
  StepObserver* observer_ = nullptr;

  // Set-points.
  bool stabilized_ = true;
  bool raw_ = false; ///< the motors are driven by set_motors
  Switch vector_drive_ = Switch::Off;
  int vector_drive_limit_ = spec::ball::default_vector_drive_limit;
  Go go_ = Go::Brake;
  int target_speed_ = 0;
  double target_deg_ = 0;
  double rotation_rate_;
  double rotate_left_deg_ = 0; ///< what is left of rotate()
  double rotate_rate_ = 0;
  Motor left_;
  Motor right_;

  // Motion. Speeds in cm/s; directions in degrees, clockwise from +Y.
  double yaw_deg_ = 0;
  double world_offset_deg_ = 0; ///< world direction = yaw + offset
  double tare_deg_ = 0;         ///< locator direction = yaw + tare
  Switch tare_correction_ = Switch::On;
  double forward_ = 0;
  double rolled_cm_ = 0;
  double left_wheel_ = 0;
  double right_wheel_ = 0;
  double drift_x_ = 0; ///< what pushes and bounces add, in world axes
  double drift_y_ = 0;
  mutable Course course_; ///< of the last call of course()
  double world_x_ = 0;
  double world_y_ = 0;
  double locator_x_ = 0;
  double locator_y_ = 0;
  double yaw_rate_ = 0;
  double forward_acceleration_ = 0;
  double tilt_pitch_deg_ = 0;
  double tilt_roll_deg_ = 0;
  double spin_deg_s_ = 0;
  Switch noise_ = Switch::Off;
  Instant shaken_until_{};
  Instant falling_until_{};
  bool landing_ = false;
  Instant struck_until_{};
  std::optional<Impact> impact_;

  // Battery: a voltage at an instant and its slope since; motion takes more.
  Switch charger_ = Switch::Off;
  Instant battery_at_{};
  double battery_v_;

  struct Obstacle {
    Wall wall;
    double side; ///< +1 or -1: where the ball was when the wall appeared
  };
  std::vector<Obstacle> walls_; ///< endless ones
  std::vector<Wall> segments_;  ///< those between two points
  double clear_cm_ = 0;         ///< so far it can go before it may touch one of these
};

} // namespace orb::vm
