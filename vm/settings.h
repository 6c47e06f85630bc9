#pragma once

#include "base/time.h"
#include "vm/body.h"

#include <cstdint>

namespace orb::vm {

/// Source: API §Configure Collision Detection.
struct CollisionSettings {
  int method = 0; ///< 0 off
  int x_threshold = 0;
  int x_speed = 0;
  int y_threshold = 0;
  int y_speed = 0;
  int dead_time_10ms = 0;
};

/// What clients set and the ball obeys. Ball acts on these; whatever else the API stores (names,
/// dates, the soul block…) belongs to the dispatcher's own state.
struct Settings {
  // Kept across power cycles.
  Color user_color;
  std::uint32_t permanent_flags = 0;
  int low_battery_cv = 700;      ///< hundredths of a volt
  int critical_battery_cv = 650; ///< hundredths of a volt
  Duration inactivity_timeout = std::chrono::seconds{600};

  // Lost in sleep.
  std::uint32_t temporary_flags = 0;
  Duration motion_timeout = std::chrono::milliseconds{2000};
  CollisionSettings collisions;
};

/// Source: API §Set Permanent Option Flags, §Set Temporary Option Flags.
namespace option {
inline constexpr std::uint32_t vector_drive = 1u << 1;
inline constexpr std::uint32_t tail_led_always_on = 1u << 3;
inline constexpr std::uint32_t motion_timeout = 1u << 4;
inline constexpr std::uint32_t stop_on_disconnect = 1u << 0; ///< a temporary flag
} // namespace option

/// Source: API §Sleep.
struct Sleep {
  int seconds = 0;      ///< until it wakes by itself; 0 never
  int macro = 0;        ///< to run then; 0 none
  int line = 0;         ///< of the program in flash to run then; 0 none
  int milliseconds = 0; ///< added to the seconds: macros count in these
};

} // namespace orb::vm
