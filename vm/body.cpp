#include "vm/body.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace orb::vm {

namespace {

using namespace spec::ball; // the numbers of the model

constexpr double hour_s = std::chrono::seconds{1h}.count();
constexpr double dt = 1.0 / control_rate; // s
constexpr double half_circle = full_circle / 2.0;
constexpr double to_radians = std::numbers::pi / half_circle;

double wrap_360(double degrees) {
  if (0 <= degrees && degrees < full_circle)
    return degrees; // nearly always: std::fmod costs ten times as much
  const double wrapped = std::fmod(degrees, full_circle);
  return wrapped < 0 ? wrapped + full_circle : wrapped;
}

/// The shortest way, -180 < way <= 180.
double shortest_turn(double from_deg, double to_deg) {
  const double way = wrap_360(to_deg - from_deg);
  return way > half_circle ? way - full_circle : way;
}

double toward(double value, double target, double most) {
  return value < target ? std::min(value + most, target) : std::max(value - most, target);
}

double seconds(Duration duration) {
  return static_cast<double>(duration.count()) * 1e-9;
}

Instant grid_after(Instant now) {
  return now + Body::step - now.time_since_epoch() % Body::step;
}

} // namespace

std::string to_string(const Wall& wall) {
  switch (wall.axis) {
  case Wall::Axis::X: return fmt::format("x={:g}", wall.at_cm);
  case Wall::Axis::Y: return fmt::format("y={:g}", wall.at_cm);
  case Wall::Axis::None: break;
  }
  return fmt::format("{:g},{:g} to {:g},{:g}", wall.from.x, wall.from.y, wall.to.x, wall.to.y);
}

Point nearest_point(const Wall& wall, Point place) {
  const Point along{wall.to.x - wall.from.x, wall.to.y - wall.from.y};
  const double length_squared = along.x * along.x + along.y * along.y;
  if (length_squared == 0)
    return wall.from;
  const double share =
      ((place.x - wall.from.x) * along.x + (place.y - wall.from.y) * along.y) / length_squared;
  const double inside = std::clamp(share, 0.0, 1.0);
  return {wall.from.x + inside * along.x, wall.from.y + inside * along.y};
}

Body::Body(std::uint64_t seed)
    : seed_(seed), rotation_rate_(default_rotation_rate), battery_v_(full_battery) {}

Instant Body::next_step() const {
  return moving() ? grid_after(now_) : never;
}

Instant Body::advance_to(Instant now) {
  for (Instant next = grid_after(now_); next <= now && moving(); next += step) {
    if (goes_straight_on()) {
      go_straight_on((now - next) / step + 1);
      break;
    }
    now_ = next;
    single_step();
    if (observer_ != nullptr)
      observer_->on_step(now_, *this);
    if (impact_)
      return now_;
  }
  if (!moving()) {
    yaw_rate_ = 0;
    forward_acceleration_ = 0;
  }
  now_ = std::max(now_, now);
  return now_;
}

std::optional<Impact> Body::take_impact() {
  const auto impact = impact_;
  impact_.reset();
  return impact;
}

/// Whether the next step changes nothing but its place.
bool Body::goes_straight_on() const {
  return rolls_freely() && stabilized_ && yaw_deg_ == target_deg_ && rotate_left_deg_ == 0 &&
         forward_ == commanded_cm_s() && !drifts() && !landing_ && !impact_;
}

void Body::go_straight_on(Duration::rep steps) {
  yaw_rate_ = forward_acceleration_ = 0;
  const auto going = course();
  for (; steps > 0; --steps)
    move_to(world_x_ + going.vx * dt, world_y_ + going.vy * dt, going.speed * dt, going.speed);
}

/// The speed that it strives for.
double Body::commanded_cm_s() const {
  return full_speed * target_speed_ / greatest;
}

void Body::single_step() {
  turn();
  drive();
  travel();
  if (landing_ && now_ >= falling_until_) {
    landing_ = false;
    struck_until_ = now_ + blow_time;
  }
}

bool Body::fast_turn() const {
  return go_ == Go::FastTurn || stopped();
}

void Body::turn() {
  const double before = yaw_deg_;
  double turned = 0;
  if (!stabilized_) {
    const double wheels = raw_ ? (left_wheel_ - right_wheel_) / track / to_radians : 0;
    turned = std::clamp(wheels + spin_deg_s_, -greatest_yaw_rate, greatest_yaw_rate) * dt;
  } else if (rotate_left_deg_ != 0) {
    const double most = rotate_rate_ * dt;
    turned = std::clamp(rotate_left_deg_, -most, most);
    rotate_left_deg_ -= turned;
  } else {
    const double most = (fast_turn() ? fast_rotation_rate : rotation_rate_) * dt;
    turned = std::clamp(shortest_turn(yaw_deg_, target_deg_), -most, most);
    if (std::abs(shortest_turn(yaw_deg_ + turned, target_deg_)) < 1e-9) {
      yaw_deg_ = target_deg_;
      yaw_rate_ = turned / dt;
      return;
    }
  }
  yaw_deg_ = wrap_360(before + turned);
  yaw_rate_ = turned / dt;
  if (stabilized_ && rotate_rate_ != 0) {
    if (rotate_left_deg_ == 0) {
      rotate_rate_ = 0;
      yaw_deg_ = target_deg_;
    }
  } else if (!stabilized_)
    target_deg_ = yaw_deg_;
}

void Body::drive() {
  const double before = forward_;
  if (raw_) {
    const auto wheel = [](double speed, const Motor& motor) {
      const double commanded = full_speed * motor.power / greatest;
      switch (motor.mode) {
      case MotorMode::Off: return toward(speed, 0, coasting * dt);
      case MotorMode::Forward: return toward(speed, commanded, acceleration * dt);
      case MotorMode::Reverse: return toward(speed, -commanded, acceleration * dt);
      case MotorMode::Brake: return toward(speed, 0, braking * dt);
      case MotorMode::Ignore: break;
      }
      return speed;
    };
    left_wheel_ = wheel(left_wheel_, left_);
    right_wheel_ = wheel(right_wheel_, right_);
    forward_ = (left_wheel_ + right_wheel_) / 2;
  } else if (!stabilized_) {
    forward_ = toward(forward_, 0, coasting * dt);
  } else {
    const bool slow = std::abs(forward_) <= full_speed * vector_drive_limit_ / greatest;
    const bool waits =
        vector_drive_ == Switch::On && slow && std::abs(shortest_turn(yaw_deg_, target_deg_)) > 1;
    const double target = waits ? 0 : commanded_cm_s();
    forward_ = toward(forward_, target, (go_ == Go::Brake ? braking : acceleration) * dt);
  }
  forward_acceleration_ = (forward_ - before) / dt;
}

const Body::Course& Body::course() const {
  const double heading = yaw_deg_ + world_offset_deg_;
  if (course_.forward != forward_ || course_.heading_deg != heading ||
      course_.drift_x != drift_x_ || course_.drift_y != drift_y_) {
    const double vx = forward_ * std::sin(heading * to_radians) + drift_x_;
    const double vy = forward_ * std::cos(heading * to_radians) + drift_y_;
    course_ = {forward_, heading, drift_x_, drift_y_, vx, vy, std::hypot(vx, vy)};
  }
  return course_;
}

void Body::travel() {
  if (drifts()) {
    const double drift = std::hypot(drift_x_, drift_y_);
    const double left = std::max(0.0, drift - drift_friction * dt) / drift;
    drift_x_ *= left;
    drift_y_ *= left;
  }
  if (forward_ == 0 && !drifts())
    return;

  const auto& going = course();
  double x = world_x_ + going.vx * dt;
  double y = world_y_ + going.vy * dt;
  const double speed = going.speed; // before a wall changes it
  if (!walls_.empty())
    hit_walls(x, y, going.vx, going.vy);
  if (!segments_.empty()) {
    Point place{x, y};
    hit_segments(place);
    x = place.x;
    y = place.y;
  }

  const bool in_the_open = walls_.empty() && segments_.empty();
  move_to(x, y, in_the_open ? speed * dt : std::hypot(x - world_x_, y - world_y_), speed);
}

void Body::move_to(double x, double y, double way_cm, double speed) {
  // The locator sees the same way, turned into its own axes.
  const double dx = x - world_x_;
  const double dy = y - world_y_;
  rolled_cm_ += way_cm;
  world_x_ = x;
  world_y_ = y;
  const double turned = tare_deg_ - world_offset_deg_;
  if (turned == 0) {
    locator_x_ += dx;
    locator_y_ += dy;
  } else {
    const double sine = std::sin(turned * to_radians);
    const double cosine = std::cos(turned * to_radians);
    locator_x_ += dx * cosine + dy * sine;
    locator_y_ += dy * cosine - dx * sine;
  }
  battery_v_ -= motion_drain / hour_s * dt * std::min(1.0, speed / full_speed);
}

void Body::hit_walls(double& x, double& y, double vx, double vy) {
  for (const auto& [wall, side] : walls_) {
    const bool across_x = wall.axis == Wall::Axis::X;
    double& place = across_x ? x : y;
    const double speed = across_x ? vx : vy;
    const double nearest = wall.at_cm + side * radius;
    const bool through = side > 0 ? place < nearest : place > nearest;
    if (!through)
      continue;
    place = nearest;
    if (speed * side >= 0)
      continue;
    if (std::abs(speed) >= least_blow) {
      strike(across_x ? speed : 0, across_x ? 0 : speed);
      impact_->wall = wall;
    }
    // What the wall leaves: the way along it, and a share of the way back.
    drift_x_ = across_x ? -restitution * vx : vx;
    drift_y_ = across_x ? vy : -restitution * vy;
    forward_ = left_wheel_ = right_wheel_ = 0;
    if (std::abs(speed) < least_blow)
      (across_x ? drift_x_ : drift_y_) = 0;
  }
}

void Body::hit_segments(Point& place) {
  const double way = std::hypot(place.x - world_x_, place.y - world_y_);
  if (way < clear_cm_) {
    clear_cm_ -= way;
    return;
  }
  // In pieces so short that none of them jumps over a wall.
  const double pieces = std::ceil(way / (radius / 2));
  const Point piece{(place.x - world_x_) / pieces, (place.y - world_y_) / pieces};
  place = {world_x_, world_y_};
  for (double done = 0; done < pieces; ++done) {
    place = {place.x + piece.x, place.y + piece.y};
    if (push_out(place))
      break; // what is left of the step is lost in the blow
  }
}

/// Moves a ball that reaches into walls out of them. True where it touched one.
bool Body::push_out(Point& place) {
  constexpr int most_rounds = 4; // out of one wall of a corner, it may be in the other
  constexpr double touch = radius - 1e-9;
  bool touched = false;
  for (int round = 0; round < most_rounds; ++round) {
    double nearest = HUGE_VAL;
    for (const auto& wall : segments_) {
      const auto foot = nearest_point(wall, place);
      const double distance = std::hypot(place.x - foot.x, place.y - foot.y);
      nearest = std::min(nearest, distance);
      if (distance >= touch || distance == 0)
        continue;
      touched = true;
      const Point normal{(place.x - foot.x) / distance, (place.y - foot.y) / distance};
      place = {foot.x + normal.x * radius, foot.y + normal.y * radius};
      bounce(wall, normal);
    }
    clear_cm_ = std::max(0.0, nearest - radius);
    if (nearest >= touch)
      return touched;
  }
  place = {world_x_, world_y_}; // a corner too narrow for the ball: it stays where it was
  return true;
}

/// What a wall leaves of a speed into it: the way along it, and a share of the way back. `normal`
/// points from the wall to the ball.
void Body::bounce(const Wall& wall, Point normal) {
  const auto going = course();
  const double into = going.vx * normal.x + going.vy * normal.y;
  if (into >= 0)
    return;
  const bool blow = -into >= least_blow;
  if (blow) {
    strike(into * normal.x, into * normal.y);
    impact_->wall = wall;
  }
  const double taken = into * (blow ? 1 + restitution : 1);
  drift_x_ = going.vx - taken * normal.x;
  drift_y_ = going.vy - taken * normal.y;
  forward_ = left_wheel_ = right_wheel_ = 0;
}

void Body::strike(double vx, double vy) {
  // Into the ball's own axes: y ahead, x to the right.
  const double world = (yaw_deg_ + world_offset_deg_) * to_radians;
  const double scale = power_per_speed * greatest / full_speed;
  Impact impact;
  impact.x_power = scale * (vx * std::cos(world) - vy * std::sin(world));
  impact.y_power = scale * (vx * std::sin(world) + vy * std::cos(world));
  impact.speed = speed();
  impact_ = impact;
  struck_until_ = now_ + blow_time;
}

void Body::power_on() {
  // Heading 0 is wherever it points; what it faces in the world does not change.
  world_offset_deg_ += yaw_deg_;
  yaw_deg_ = target_deg_ = tare_deg_ = 0;
  tare_correction_ = Switch::On;
  locator_x_ = locator_y_ = 0;
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

Outcome Body::obey(const Motion& motion) {
  return std::visit([&](const auto& one) { return obey_one(one); }, motion);
}

Outcome Body::obey_one(const Roll& roll) {
  if (!stabilized_)
    return Outcome::Refused;
  target_deg_ = roll.heading_deg;
  target_speed_ = roll.go == Go::Brake ? 0 : roll.speed;
  go_ = roll.go;
  rotate_left_deg_ = 0;
  rotate_rate_ = 0;
  return Outcome::Done;
}

Outcome Body::obey_one(const Rotate& turn) {
  if (!stabilized_)
    return Outcome::Refused;
  const double least = std::abs(turn.angle_deg) / greatest_yaw_rate;
  rotate_left_deg_ = turn.angle_deg;
  rotate_rate_ = std::abs(turn.angle_deg) / std::max({least, seconds(turn.time), dt});
  target_deg_ = wrap_360(yaw_deg_ + turn.angle_deg);
  return Outcome::Done;
}

Outcome Body::obey_one(const SetSpeed& change) {
  if (!stabilized_)
    return Outcome::Refused;
  target_speed_ = change.speed;
  go_ = roll_at(change.speed).go;
  return Outcome::Done;
}

Roll Body::roll_at(int speed) const {
  const auto heading = static_cast<int>(std::lround(target_deg_)) % full_circle;
  return {heading, speed, speed == 0 ? Go::Brake : Go::Drive};
}

Outcome Body::obey_one(const Stop&) {
  target_speed_ = 0;
  go_ = Go::Brake;
  if (raw_)
    left_ = right_ = {MotorMode::Off, 0};
  return Outcome::Done;
}

Outcome Body::obey_one(const RotationRate& rate) {
  rotation_rate_ = rate.deg_per_s;
  return Outcome::Done;
}

Outcome Body::obey_one(const Motors& motors) {
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

Outcome Body::obey_one(Stabilization mode) {
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

void Body::set_vector_drive(Switch vector_drive) {
  vector_drive_ = vector_drive;
}

Outcome Body::obey_one(const SetHeading& name) {
  const double turned = yaw_deg_ - name.heading_deg;
  world_offset_deg_ += turned;
  if (tare_correction_ == Switch::On)
    tare_deg_ += turned;
  yaw_deg_ = target_deg_ = name.heading_deg;
  rotate_left_deg_ = rotate_rate_ = 0;
  return Outcome::Done;
}

void Body::locate(double x_cm, double y_cm) {
  locator_x_ = x_cm;
  locator_y_ = y_cm;
}

void Body::set_yaw_tare(int tare_deg) {
  tare_deg_ = tare_deg;
}

void Body::set_tare_correction(Switch correct_on_set_heading) {
  tare_correction_ = correct_on_set_heading;
}

void Body::add_wall(const Wall& wall) {
  if (wall.axis == Wall::Axis::None) {
    segments_.push_back(wall);
    clear_cm_ = 0;
    return;
  }
  const double place = wall.axis == Wall::Axis::X ? world_x_ : world_y_;
  walls_.push_back({wall, place < wall.at_cm ? -1.0 : 1.0});
}

void Body::push(int heading_deg, int strength) {
  const double direction = heading_deg * to_radians;
  const double speed = full_speed * strength / greatest;
  const double vx = speed * std::sin(direction);
  const double vy = speed * std::cos(direction);
  // A push to the right is a blow on the left side.
  strike(-vx, -vy);
  drift_x_ += vx;
  drift_y_ += vy;
}

void Body::shake() {
  shaken_until_ = now_ + shake_time;
}

void Body::toss(Duration time) {
  falling_until_ = now_ + time;
  landing_ = true;
}

void Body::tilt(double pitch_deg, double roll_deg) {
  tilt_pitch_deg_ = pitch_deg;
  tilt_roll_deg_ = roll_deg;
}

void Body::spin(double deg_per_s) {
  spin_deg_s_ = deg_per_s;
}

void Body::set_battery(double volts) {
  battery_v_ = volts;
  battery_at_ = now_;
}

void Body::set_charger(Switch charger) {
  set_battery(battery_v());
  charger_ = charger;
}

bool Body::stopped() const {
  return std::abs(forward_) < stopped_below &&
         (!drifts() || std::hypot(drift_x_, drift_y_) < stopped_below);
}

double Body::left_motor_cm_s() const {
  return raw_ ? left_wheel_ : forward_;
}
double Body::right_motor_cm_s() const {
  return raw_ ? right_wheel_ : forward_;
}

int Body::left_motor_power() const {
  return static_cast<int>(std::lround(left_motor_cm_s() / full_speed * greatest));
}

int Body::right_motor_power() const {
  return static_cast<int>(std::lround(right_motor_cm_s() / full_speed * greatest));
}

Vector3 Body::velocity_cm_s() const {
  if (tare_deg_ == world_offset_deg_) // the locator has the world's axes
    return {course().vx, course().vy, 0};
  const double way = (yaw_deg_ + tare_deg_) * to_radians;
  const double turned = (tare_deg_ - world_offset_deg_) * to_radians;
  const double sine = std::sin(turned);
  const double cosine = std::cos(turned);
  return {forward_ * std::sin(way) + drift_x_ * cosine + drift_y_ * sine,
          forward_ * std::cos(way) + drift_y_ * cosine - drift_x_ * sine, 0};
}

double Body::speed_cm_s() const {
  if (tare_deg_ == world_offset_deg_)
    return course().speed;
  const auto velocity = velocity_cm_s();
  return std::hypot(velocity.x, velocity.y);
}

Pose Body::pose() const {
  return {locator_x_, locator_y_, yaw_deg_, speed_cm_s()};
}

Pose Body::world_pose() const {
  return {world_x_, world_y_, wrap_360(yaw_deg_ + world_offset_deg_), course().speed};
}

int Body::speed() const {
  return static_cast<int>(std::lround(std::min(speed_cm_s() / full_speed, 1.0) * greatest));
}

double Body::yaw_deg() const {
  return yaw_deg_;
}

double Body::pitch_deg() const {
  const double lifted = std::atan2(forward_acceleration_, gravity) / to_radians;
  return std::clamp(tilt_pitch_deg_ + lifted + noise(0) * noise_deg, -half_circle / 2,
                    half_circle / 2);
}

double Body::roll_deg() const {
  return std::clamp(tilt_roll_deg_ + noise(1) * noise_deg, -half_circle, half_circle);
}

Vector3 Body::acceleration_g() const {
  if (now_ < falling_until_)
    return {};
  const double pitch = tilt_pitch_deg_ * to_radians;
  const double roll = tilt_roll_deg_ * to_radians;
  Vector3 felt{-std::sin(roll) * std::cos(pitch) + forward_ * yaw_rate_ * to_radians / gravity,
               std::sin(pitch) + forward_acceleration_ / gravity, std::cos(roll) * std::cos(pitch)};
  if (now_ < shaken_until_)
    felt.x += (shaken_until_ - now_) / shake_half_period % 2 == 0 ? shake_g : -shake_g;
  if (now_ < struck_until_)
    felt.y += blow_g;
  felt.x += noise(2) * noise_g;
  felt.y += noise(3) * noise_g;
  felt.z += noise(4) * noise_g;
  return felt;
}

double Body::acceleration_total_g() const {
  const auto felt = acceleration_g();
  return std::sqrt(felt.x * felt.x + felt.y * felt.y + felt.z * felt.z);
}

Vector3 Body::rotation_deg_s() const {
  return {noise(5) * noise_deg, noise(6) * noise_deg, yaw_rate_ + noise(7) * noise_deg};
}

Quaternion Body::attitude() const {
  // Headings count clockwise, quaternions counter-clockwise about Z.
  const double yaw = -yaw_deg_ * to_radians / 2;
  const double pitch = pitch_deg() * to_radians / 2;
  const double roll = roll_deg() * to_radians / 2;
  const double cy = std::cos(yaw), sy = std::sin(yaw);
  const double cp = std::cos(pitch), sp = std::sin(pitch);
  const double cr = std::cos(roll), sr = std::sin(roll);
  return {cr * cp * cy + sr * sp * sy, cr * sp * cy + sr * cp * sy, sr * cp * cy - cr * sp * sy,
          cr * cp * sy - sr * sp * cy};
}

double Body::battery_v() const {
  const double elapsed = seconds(now_ - battery_at_);
  if (charger_ == Switch::On)
    return std::max(battery_v_,
                    std::min(charged_battery, battery_v_ + charge_rate / hour_s * elapsed));
  return std::max(std::min(battery_v_, empty_battery), battery_v_ - idle_drain / hour_s * elapsed);
}

Instant Body::battery_reaches(double volts) const {
  const double above = battery_v() - volts;
  if (charging() || above <= 0)
    return never;
  return now_ + Duration{static_cast<Duration::rep>(above / (idle_drain / hour_s) * 1e9) + 1};
}

Instant Body::battery_above_until(double volts) const {
  if (charging())
    return never;
  constexpr double fastest = (idle_drain + motion_drain) / hour_s;
  constexpr double nearly = 0.999; // what the roundings of many steps may amount to
  const double above = std::max(0.0, battery_v() - volts);
  return now_ + Duration{static_cast<Duration::rep>(above / fastest * nearly * 1e9)};
}

double Body::noise(std::uint32_t channel) const {
  if (noise_ == Switch::Off)
    return 0;
  // A value of its own for each channel in each step of the control system.
  Random random{seed_ + Random::stride * channel +
                static_cast<std::uint64_t>(now_.time_since_epoch() / step)};
  return static_cast<double>(random.next() >> 11) * 0x1p-53 * 2 - 1; // -1 to 1 from 53 bits
}

} // namespace orb::vm
