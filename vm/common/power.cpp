#include "vm/common/power.h"

#include "spec/unit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orb::vm {
namespace {

namespace state = spec::power_state;

using spec::ball::sleep_warning;

constexpr auto centivolt = spec::scale_of("0.01 V");

} // namespace

Power::Power(const Settings& settings) {
  stay_awake({}, settings);
}

bool Power::battery_warns() const {
  return battery_state_ == state::low || battery_state_ == state::critical;
}

Power::Change Power::check_battery(const Body& body, const Settings& settings) {
  // Round up to hundredths, ignoring rounding errors of the arithmetic.
  const int centivolts = static_cast<int>(std::ceil(centivolt.of(body.battery_v()) - 1e-6));
  const auto now = body.charging()                              ? state::charging
                   : centivolts <= settings.critical_battery_cv ? state::critical
                   : centivolts <= settings.low_battery_cv      ? state::low
                                                                : state::ok;
  const int next = now == state::ok
                       ? std::max(settings.low_battery_cv, settings.critical_battery_cv)
                   : now == state::low ? settings.critical_battery_cv
                                       : 0;
  constexpr double dust = 1e-4; // V: margin for the rounding above
  battery_holds_until_ = body.battery_above_until(next / centivolt.steps + dust);
  return std::exchange(battery_state_, now) == now ? Change::None : Change::Changed;
}

void Power::stay_awake(Instant now, const Settings& settings) {
  inactive_at_ = now + settings.inactivity_timeout;
  warned_ = false;
}

bool Power::sleeps_soon(Instant now) const {
  return now >= inactive_at_ - sleep_warning;
}

void Power::begin_sleep(Instant now) {
  last_ = *std::exchange(asked_, std::nullopt);
  const Duration time =
      std::chrono::seconds{last_.seconds} + std::chrono::milliseconds{last_.milliseconds};
  wake_at_ = time == Duration{} ? never : now + time;
}

Sleep Power::wake(Instant now) {
  asleep_ = false;
  return wake_at_ <= now ? last_ : Sleep{};
}

Instant Power::next_event(const Body& body, const Settings& settings) const {
  if (asleep_)
    return wake_at_;
  const Instant tired = warned_ ? inactive_at_ : inactive_at_ - sleep_warning;
  const Instant other = std::min(wake_at_, tired);
  if (other <= battery_holds_until_)
    return other;
  const auto trips = [&](int centivolts) {
    return body.battery_reaches(centivolts / centivolt.steps);
  };
  const Instant lower = battery_state_ == state::ok    ? trips(settings.low_battery_cv)
                        : battery_state_ == state::low ? trips(settings.critical_battery_cv)
                                                       : never;
  return std::min(other, lower);
}

} // namespace orb::vm
