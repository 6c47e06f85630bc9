// Events from outside, and the events that a ball reports.

#include "vm/ball.h"

#include "protocol/payload.h"
#include "vm/ball_asks.h"

#include <algorithm>
#include <cmath>

namespace orb::vm {
namespace {

using spec::BasicFlag;
using spec::MacroFlag;

std::int32_t rounded_s16(double value) {
  return static_cast<std::int32_t>(std::lround(std::clamp<double>(value, INT16_MIN, INT16_MAX)));
}

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

} // namespace

void Ball::apply(const Stimulus& stimulus) {
  body_.advance_to(now_);
  std::visit(Overloaded{
                 [&](const Wall& wall) { body_.add_wall(wall); },
                 [&](const stimulus::Shake&) {
                   if (asleep())
                     wake();
                   double_shake_ = true;
                   body_.shake();
                 },
                 [&](const stimulus::Toss& toss) { body_.toss(toss.time); },
                 [&](const stimulus::Push& push) {
                   body_.push(push.heading_deg, push.strength);
                   if (const auto impact = body_.take_impact())
                     detect_collision(*impact);
                 },
                 [&](const stimulus::ClientRoll& client) { drive(client.roll); },
                 [&](const stimulus::ClientColor& client) { set_led(client.color); },
                 [&](const stimulus::Connect&) { connect(); },
                 [&](const stimulus::Disconnect&) { disconnect(); },
                 [&](const stimulus::Battery& battery) { body_.set_battery(battery.volts); },
                 [&](const stimulus::Charger& charger) { body_.set_charger(charger.state); },
                 [&](const stimulus::Number& number) { programs_.deliver(number.value, now_); },
                 [&](const stimulus::Tilt& tilt) { body_.tilt(tilt.pitch_deg, tilt.roll_deg); },
                 [&](const stimulus::Spin& spin) { body_.spin(spin.deg_per_s); },
                 [&](const stimulus::Noise& noise) { body_.set_noise(noise.state); },
             },
             stimulus);
  settle();
  check_battery();
  watch_motion();
}

// A remote robot as the body.

void Ball::become(RemoteBody& robot) {
  body_.become(robot);
  lamps_.become(robot);
}

void Ball::feel(const Sample& sample) {
  body_.advance_to(now_);
  body_.feel(sample);
  felt_at_ = now_;
  double_shake_ = double_shake_ || shakes_.feel(sample.acceleration_g, now_);
  watch_motion();
}

void Ball::feel(const event::Collision& collision) {
  trace(collision);
  macros_.collide(now_);
  dispatcher_.on_collision();
}

void Ball::detect_collision(const Impact& impact) {
  const auto& settings = settings_.collisions;
  if (asleep() || settings.method == 0 || now_ < deaf_until_)
    return;
  const auto exceeds = [&](double power, int threshold, int by_speed) {
    return threshold != 0 &&
           std::abs(power) > threshold + by_speed * impact.speed / double{spec::ball::greatest};
  };
  event::Collision collision;
  collision.axis = (exceeds(impact.x_power, settings.x_threshold, settings.x_speed) ? 1 : 0) |
                   (exceeds(impact.y_power, settings.y_threshold, settings.y_speed) ? 2 : 0);
  if (collision.axis == 0)
    return;
  deaf_until_ = now_ + std::chrono::milliseconds{10} * settings.dead_time_10ms;
  collision.x = rounded_s16(impact.x_power * spec::ball::impact_per_power);
  collision.y = rounded_s16(impact.y_power * spec::ball::impact_per_power);
  collision.x_magnitude = rounded_s16(std::abs(impact.x_power));
  collision.y_magnitude = rounded_s16(std::abs(impact.y_power));
  collision.speed = impact.speed;
  trace(collision);

  send(protocol::make_async(spec::AsyncId::Collision,
                            {collision.x, collision.y, 0, collision.axis, collision.x_magnitude,
                             collision.y_magnitude, collision.speed, link_.clock_ms(now_)}));
  macros_.collide(now_);
  dispatcher_.on_collision();
}

void Ball::check_battery() {
  if (power_.check_battery(body_, settings_) == Power::Change::None)
    return;
  show_lamps();
  dispatcher_.on_battery();
}

/// The battery drains slowly, so it is checked only when it can have changed state.
void Ball::watch_battery() {
  if (now_ >= power_.battery_holds_until())
    check_battery();
}

// Requests.

void Ball::change(const Settings& settings) {
  const bool other_timeout = settings.inactivity_timeout != settings_.inactivity_timeout;
  settings_ = settings;
  if (other_timeout)
    stay_awake(); // the new timeout counts from now
  body_.set_vector_drive(settings_.has(spec::permanent_option_flags::vector_drive) ? Switch::On
                                                                                   : Switch::Off);
  drive_.settings_changed();
  check_battery();
  show_lamps();
}

void Ball::restore(const Settings& settings, const Profile& profile) {
  dispatcher_.restore(profile);
  change(settings);
}

MacroOutcome Ball::run_macro(int id) {
  const auto outcome = macros_.start(id, now_);
  settle();
  return outcome;
}

void Ball::drive(Actor actor, const Motion& motion) {
  if (drive_.obey(actor, motion, now_) == Outcome::Refused)
    return;
  if (const auto* roll = std::get_if<Roll>(&motion))
    trace(event::Drive{*roll});
  if (const auto* change = std::get_if<SetSpeed>(&motion))
    trace(event::Drive{body_.roll_at(change->speed)});
  if (Drive::may_move(motion))
    watch_motion();
}

void Ball::share_drive() {
  drive_.share({.by_program = programs_.running() && programs_.has(BasicFlag::ExclusiveDrive),
                .by_macro = macros_.has(MacroFlag::ExclusiveDrv)});
}

void Ball::set_led(Actor actor, Color color) {
  lamps_.set(actor, color);
  show_lamps();
}

void Ball::set_back_led(int level) {
  lamps_.set_back(level);
  show_lamps();
}

Lamps::Situation Ball::lamp_situation() const {
  return {.now = now_,
          .asleep = asleep(),
          .battery_warns = power_.battery_warns(),
          .connected = connected(),
          .program_first = programs_.running() && programs_.has(BasicFlag::KeepLed),
          .tail_always_on = settings_.has(spec::permanent_option_flags::tail_light),
          .user_color = settings_.user_color};
}

void Ball::show_lamps() {
  const auto situation = lamp_situation();
  if (const auto color = lamps_.show(situation))
    trace(event::Led{*color});
  if (const auto level = lamps_.show_back(situation))
    trace(event::BackLed{*level});
}

void Ball::show_matrix(const std::array<Color, 64>& pixels) {
  trace(event::Matrix{pixels});
}

// Sleep.

bool Ball::keeps_awake() const {
  return (programs_.running() && !programs_.has(BasicFlag::Stealth)) ||
         (macros_.running() && !macros_.has(MacroFlag::Stealth));
}

void Ball::shut_down() {
  programs_.abort();
  macros_.abort(now_);
  settle();
  streamer_.stop();
  drive(Stop{});
}

void Ball::fall_asleep() {
  trace(event::Sleep{power_.asked().seconds, power_.asked().macro, power_.asked().line});
  power_.begin_sleep(now_);
  programs_.stop(event::End::Reason::Sleep);
  macros_.fall_asleep(now_);
  settle();
  dispatcher_.on_sleep();
  streamer_.stop();
  link_.close();
  programs_.forget_ram();
  settings_.fall_asleep();
  drive_.fall_asleep();
  lamps_.fall_asleep();
  double_shake_ = false;
  body_.power_on();
  power_.fall_asleep();
  watch_motion();
  show_lamps();
}

void Ball::wake() {
  const auto plan = power_.wake(now_);
  body_.advance_to(now_);
  body_.power_on();
  dispatcher_.on_wake();
  stay_awake();
  check_battery();
  show_lamps();
  if (plan.macro != 0)
    run_macro(plan.macro);
  if (plan.line != 0)
    execute_basic(Area::Flash, plan.line);
  power_.awake(); // set last: the ball must not look idle in between
}

} // namespace orb::vm
