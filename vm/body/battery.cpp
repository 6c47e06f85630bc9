#include "vm/body/battery.h"

#include "vm/body/angles.h"

namespace orb::vm {

using namespace spec::ball; // figures of the model

namespace {
constexpr double hour_s = std::chrono::seconds{1h}.count();
} // namespace

void Battery::drain(double speed_cm_s) {
  constexpr double at_full_speed = motion_drain / hour_s * step_s;
  constexpr double of_full_speed = 1 / full_speed;
  volts_ -= at_full_speed * std::min(1.0, speed_cm_s * of_full_speed);
}

void Battery::set(double volts, Instant now) {
  volts_ = volts;
  at_ = now;
}

void Battery::set_charger(Switch charger, Instant now) {
  set(volts(now), now);
  charger_ = charger;
}

double Battery::volts(Instant now) const {
  const double elapsed = seconds(now - at_);
  if (charging())
    return std::max(volts_, std::min(range_.charged, volts_ + charge_rate / hour_s * elapsed));
  return std::max(std::min(volts_, range_.empty), volts_ - idle_drain / hour_s * elapsed);
}

Instant Battery::reaches(double volts_wanted, Instant now) const {
  const double above = volts(now) - volts_wanted;
  if (charging() || above <= 0)
    return never;
  return now + Duration{static_cast<Duration::rep>(above / (idle_drain / hour_s) * 1e9) + 1};
}

Instant Battery::above_until(double volts_wanted, Instant now) const {
  if (charging())
    return never;
  constexpr double fastest = (idle_drain + motion_drain) / hour_s;
  constexpr double nearly = 0.999; // margin for the rounding errors of many steps
  const double above = std::max(0.0, volts(now) - volts_wanted);
  return now + Duration{static_cast<Duration::rep>(above / fastest * nearly * 1e9)};
}

} // namespace orb::vm
