#pragma once

#include "base/time.h"
#include "spec/api.h"
#include "vm/body/body.h"
#include "vm/settings.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

/// Whether the ball is awake and how its battery is: sleep and its end, inactivity, trip points.
class Power {
public:
  explicit Power(const Settings& settings);

  // Battery. Source: API §Get Power State.
  /// Of spec::power_state.
  std::uint8_t battery_state() const { return battery_state_; }
  /// Low or critical.
  bool battery_warns() const;
  enum class Change : std::uint8_t { None, Changed };
  Change check_battery(const Body& body, const Settings& settings);
  /// Until then the battery drains into no other state, however the ball drives.
  Instant battery_holds_until() const { return battery_holds_until_; }

  // Inactivity.
  /// The time until the ball falls asleep by itself counts from now.
  void stay_awake(Instant now, const Settings& settings);
  /// Whether it is time to warn of sleep, and the client has not been warned.
  bool warns(Instant now) const { return !warned_ && sleeps_soon(now); }
  void warned() { warned_ = true; }
  bool sleeps_soon(Instant now) const;
  bool inactive(Instant now) const { return now >= inactive_at_; }

  // Sleep.
  bool asleep() const { return asleep_; }
  /// It falls asleep as soon as whoever asked has returned.
  void ask_to_sleep(const Sleep& sleep) { asked_ = sleep; }
  bool falls_asleep() const { return asked_.has_value(); }
  /// Takes the ask up: it counts from now when it will wake.
  void begin_sleep(Instant now);
  const Sleep& asked() const { return *asked_; }
  void fall_asleep() { asleep_ = true; }
  /// How it fell asleep last.
  const Sleep& last_sleep() const { return last_; }
  /// When it wakes up by itself; `never` when it does not.
  Instant wake_at() const { return wake_at_; }
  /// Wakes up: with what to run where it is time, without anything where something else woke it.
  Sleep wake(Instant now);
  /// What was to run has been started.
  void awake() { wake_at_ = never; }

  /// When one of these is due.
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
