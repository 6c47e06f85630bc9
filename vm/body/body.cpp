#include "vm/body/body.h"

#include "vm/body/angles.h"

namespace orb::vm {

using namespace spec::ball; // figures of the model

namespace {

Instant grid_after(Instant now) {
  return now + Body::step - now.time_since_epoch() % Body::step;
}

/// Converts a speed to the scale 0 to 255.
double on_scale(double speed_cm_s) {
  return speed_cm_s / full_speed * greatest;
}

} // namespace

Body::Body(std::uint64_t seed, const spec::Driving& numbers, const Placement& start,
           spec::Robot robot)
    : drive_(numbers), sensors_(seed), battery_(spec::battery(robot)), axes_(spec::axes(robot)),
      world_(start.place) {
  drive_.start_facing(start.facing_deg);
}

Instant Body::next_step() const {
  return moving() && !felt_ ? grid_after(now_) : never;
}

Instant Body::advance_to(Instant now) {
  if (felt_)
    return now_ = std::max(now_, now);
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
  if (!moving())
    drive_.rest();
  now_ = std::max(now_, now);
  return now_;
}

std::optional<Impact> Body::take_impact() {
  const auto impact = impact_;
  impact_.reset();
  return impact;
}

/// Returns true if the next steps change nothing but place and speed.
bool Body::goes_straight_on() const {
  return rolls_freely() && drive_.straight() && !sensors_.falls() && !impact_;
}

void Body::go_straight_on(Duration::rep steps) {
  for (; steps > 0; --steps) {
    drive_.step_straight();
    const auto going = drive_.course();
    move_to({world_.x + going.vx * step_s, world_.y + going.vy * step_s}, going.speed * step_s,
            going.speed);
  }
}

void Body::single_step() {
  drive_.step();
  if (drive_.rolls())
    travel();
  if (sensors_.falls())
    sensors_.step(now_);
}

void Body::travel() {
  const auto going = drive_.course(); // copied before a wall changes it
  Point place{world_.x + going.vx * step_s, world_.y + going.vy * step_s};
  if (walls_.empty()) {
    move_to(place, going.speed * step_s, going.speed);
    return;
  }
  if (const auto blow = walls_.meet(world_, place, drive_)) {
    strike({blow->vx, blow->vy}, blow->speed);
    impact_->wall = blow->wall;
  }
  move_to(place, vm::length(place.x - world_.x, place.y - world_.y), going.speed);
}

void Body::move_to(Point place, double way_cm, double speed) {
  // The locator adds the same displacement, rotated into its own axes.
  const double dx = place.x - world_.x;
  const double dy = place.y - world_.y;
  rolled_cm_ += way_cm;
  world_ = place;
  const double turned = tare_deg_ - drive_.world_offset_deg();
  if (turned == 0) {
    locator_.x += dx;
    locator_.y += dy;
  } else {
    const double sine = vm::sine(turned * to_radians);
    const double cosine = vm::cosine(turned * to_radians);
    locator_.x += dx * cosine + dy * sine;
    locator_.y += dy * cosine - dx * sine;
  }
  battery_.drain(speed);
}

void Body::strike(Point velocity, double speed) {
  // Rotate into the ball's own axes: y ahead, x to the right.
  const double world = (drive_.yaw_deg() + drive_.world_offset_deg()) * to_radians;
  const double scale = power_per_speed * greatest / full_speed;
  Impact impact;
  impact.x_power = scale * (velocity.x * vm::cosine(world) - velocity.y * vm::sine(world));
  impact.y_power = scale * (velocity.x * vm::sine(world) + velocity.y * vm::cosine(world));
  impact.speed = static_cast<int>(std::lround(std::min(speed / full_speed, 1.0) * greatest));
  impact_ = impact;
  sensors_.strike(now_);
}

void Body::power_on() {
  drive_.power_on();
  tare_deg_ = 0;
  tare_correction_ = Switch::On;
  locator_ = {};
}

Outcome Body::obey(const Motion& motion) {
  const auto outcome = std::visit([&](const auto& one) { return obey_one(one); }, motion);
  if (robot_ != nullptr && outcome == Outcome::Done)
    tell_robot(motion);
  return outcome;
}

// A remote robot as the body.

void Body::become(RemoteBody& robot) {
  robot_ = &robot;
  felt_.emplace();
}

bool Body::robot_moves() const {
  constexpr double crawl = 1; // cm/s: less is sensor noise
  return drive_.is_driven() || vm::length(felt_->velocity_cm_s.x, felt_->velocity_cm_s.y) > crawl;
}

/// Passes a motion on with the robot's own heading. Heading names are kept here, because the robot
/// never renames its own.
void Body::tell_robot(const Motion& motion) {
  const auto own = [&](Roll roll) {
    const auto heading = std::lround(wrap_360(roll.heading_deg + drive_.world_offset_deg()));
    roll.heading_deg = static_cast<int>(heading % full_circle);
    return roll;
  };
  if (const auto* roll = std::get_if<Roll>(&motion))
    robot_->obey(own(*roll));
  else if (const auto* change = std::get_if<SetSpeed>(&motion))
    robot_->obey(own(drive_.roll_at(change->speed)));
  else if (!std::holds_alternative<SetHeading>(motion))
    robot_->obey(motion);
}

void Body::feel(const Sample& sample) {
  const double way = vm::length(sample.place_cm.x - world_.x, sample.place_cm.y - world_.y);
  felt_ = sample;
  drive_.face(wrap_360(sample.yaw_deg - drive_.world_offset_deg()));
  move_to(sample.place_cm, way, vm::length(sample.velocity_cm_s.x, sample.velocity_cm_s.y));
}

Outcome Body::obey_one(const SetHeading& name) {
  const double turned = drive_.rename_heading(name.heading_deg);
  if (tare_correction_ == Switch::On)
    tare_deg_ += turned;
  return Outcome::Done;
}

void Body::push(int heading_deg, int strength) {
  const double direction = heading_deg * to_radians;
  const double speed = full_speed * strength / greatest;
  const Point velocity{speed * vm::sine(direction), speed * vm::cosine(direction)};
  // A push to the right hits the left side.
  strike({-velocity.x, -velocity.y}, drive_.course().speed);
  drive_.push(velocity);
}

void Body::meet(const Shove& shove) {
  if (shove.shift != Point{})
    move_aside(shove.shift);
  if (shove.change == Point{})
    return;
  if (shove.knocks.empty())
    return drive_.press(shove.change);
  const auto going = drive_.course();
  drive_.bounce({going.vx + shove.change.x, going.vy + shove.change.y});
}

/// Moves out of another ball, but not into a wall.
void Body::move_aside(Point shift) {
  Point place{world_.x + shift.x, world_.y + shift.y};
  auto still = drive_; // a copy: its next step handles driving into the wall
  if (!walls_.empty())
    walls_.meet(world_, place, still);
  move_to(place, 0, 0);
}

Mover Body::mover() const {
  if (felt_)
    return {world_, {felt_->velocity_cm_s.x, felt_->velocity_cm_s.y}};
  const auto going = drive_.course();
  return {world_, {going.vx, going.vy}};
}

Movement Body::movement() const {
  return {now_, drive_.yaw_deg(), drive_.yaw_rate_deg_s(), drive_.forward_acceleration_cm_s2(),
          drive_.sideways_acceleration_cm_s2()};
}

Vector3 Body::velocity_cm_s() const {
  if (felt_) {
    const double turned = (tare_deg_ - drive_.world_offset_deg()) * to_radians;
    const auto [x, y, z] = felt_->velocity_cm_s;
    return {x * vm::cosine(turned) + y * vm::sine(turned),
            y * vm::cosine(turned) - x * vm::sine(turned), z};
  }
  if (tare_deg_ == drive_.world_offset_deg()) // the locator's axes are the world's
    return {drive_.course().vx, drive_.course().vy, 0};
  const auto drift = drive_.drift_cm_s();
  const auto own = drive_.own_velocity_cm_s(drive_.yaw_deg() + tare_deg_);
  const double turned = (tare_deg_ - drive_.world_offset_deg()) * to_radians;
  const double sine = vm::sine(turned);
  const double cosine = vm::cosine(turned);
  return {own.x + drift.x * cosine + drift.y * sine, own.y + drift.y * cosine - drift.x * sine, 0};
}

double Body::speed_cm_s() const {
  if (felt_)
    return vm::length(felt_->velocity_cm_s.x, felt_->velocity_cm_s.y);
  if (tare_deg_ == drive_.world_offset_deg())
    return drive_.course().speed;
  const auto velocity = velocity_cm_s();
  return vm::length(velocity.x, velocity.y);
}

Pose Body::pose() const {
  return {locator_.x, locator_.y, drive_.yaw_deg(), speed_cm_s()};
}

Pose Body::world_pose() const {
  return {world_.x, world_.y, wrap_360(drive_.yaw_deg() + drive_.world_offset_deg()),
          felt_ ? speed_cm_s() : drive_.course().speed};
}

int Body::speed() const {
  return static_cast<int>(std::lround(std::min(speed_cm_s() / full_speed, 1.0) * greatest));
}

int Body::left_motor_power() const {
  return static_cast<int>(std::lround(on_scale(drive_.left_motor_cm_s())));
}

int Body::right_motor_power() const {
  return static_cast<int>(std::lround(on_scale(drive_.right_motor_cm_s())));
}

double Body::acceleration_total_g() const {
  const auto felt = acceleration_g();
  return std::sqrt(felt.x * felt.x + felt.y * felt.y + felt.z * felt.z);
}

} // namespace orb::vm
