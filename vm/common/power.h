#pragma once

#include "base/time.h"
#include "spec/api.h"
#include "vm/body/body.h"
#include "vm/common/settings.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

/// Sleep, inactivity time-out and battery trip points.
class Power {
public:
  explicit Power(const Settings& settings);

  // Battery. Source: API §Get Power State.
  /// A value of spec::power_state.
  std::uint8_t battery_state() const { return battery_state_; }
  /// Low or critical.
  bool battery_warns() const;
  enum class Change : std::uint8_t { None, Changed };
  Change check_battery(const Body& body, const Settings& settings);
  /// The battery state certainly does not fall until then, however the ball drives.
  Instant battery_holds_until() const { return battery_holds_until_; }

  // Inactivity.
  /// Restarts the inactivity time-out.
  void stay_awake(Instant now, const Settings& settings);
  /// Returns true if the client is due a warning of sleep and has not had one.
  bool warns(Instant now) const { return !warned_ && sleeps_soon(now); }
  void warned() { warned_ = true; }
  bool sleeps_soon(Instant now) const;
  bool inactive(Instant now) const { return now >= inactive_at_; }

  // Sleep.
  bool asleep() const { return asleep_; }
  /// Makes the ball fall asleep as soon as the caller has returned.
  void ask_to_sleep(const Sleep& sleep) { asked_ = sleep; }
  bool falls_asleep() const { return asked_.has_value(); }
  /// Accepts the request; the wake-up time counts from now.
  void begin_sleep(Instant now);
  const Sleep& asked() const { return *asked_; }
  void fall_asleep() { asleep_ = true; }
  /// The request behind the last sleep.
  const Sleep& last_sleep() const { return last_; }
  /// When it wakes by itself; `never` if it does not.
  Instant wake_at() const { return wake_at_; }
  /// Wakes up. Returns what to run if it is time for that; otherwise something else woke it and
  /// nothing is to run.
  Sleep wake(Instant now);
  /// Marks that what was to run has been started.
  void awake() { wake_at_ = never; }

  /// The next wake-up, inactivity warning, sleep or trip point.
  Instant next_event(const Body& body, const Settings& settings) const;

private:
  std::uint8_t battery_state_ = spec::power_state::ok;
  Instant battery_holds_until_{};
  Instant inactive_at_;
  bool warned_ = false;
  bool asleep_ = false;
  std::optional<Sleep> asked_;
  Sleep last_;
  Instant wake_at_ = never;
};

} // namespace orb::vm
