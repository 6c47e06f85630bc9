#pragma once

#include "base/time.h"
#include "spec/api.h"
#include "spec/ball.h"
#include "vm/body/body.h"

#include <cstdint>

namespace orb::vm {

/// Source: API §Configure Collision Detection.
struct CollisionSettings {
  int method = 0; ///< 0: off
  int x_threshold = 0;
  int x_speed = 0;
  int y_threshold = 0;
  int y_speed = 0;
  int dead_time_10ms = 0;
};

/// Settings that clients change and the ball acts on. Other values that the API stores (names,
/// dates, the soul block…) belong to the dispatcher's own state.
struct Settings {
  /// Returns true if this flag of spec::permanent_option_flags is set.
  bool has(std::uint32_t permanent_flag) const { return (permanent_flags & permanent_flag) != 0; }

  /// Resets what is lost in sleep.
  void fall_asleep() {
    const Settings fresh;
    temporary_flags = fresh.temporary_flags;
    motion_timeout = fresh.motion_timeout;
    collisions = fresh.collisions;
  }

  // Kept across power cycles.
  Color user_color;
  std::uint32_t permanent_flags = 0;
  int low_battery_cv = spec::ball::default_low_battery;           ///< hundredths of a volt
  int critical_battery_cv = spec::ball::default_critical_battery; ///< hundredths of a volt
  Duration inactivity_timeout = spec::ball::default_inactivity_timeout;

  // Lost in sleep.
  std::uint32_t temporary_flags = 0;
  Duration motion_timeout = spec::ball::default_motion_timeout;
  CollisionSettings collisions;
};

/// Source: API §Sleep.
struct Sleep {
  int seconds = 0;      ///< until it wakes by itself; 0: never
  int macro = 0;        ///< runs on wake-up; 0: none
  int line = 0;         ///< line of the flash program that runs on wake-up; 0: none
  int milliseconds = 0; ///< in addition to the seconds, because macros count milliseconds
};

} // namespace orb::vm
