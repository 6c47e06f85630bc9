#pragma once

#include "base/time.h"

#include <cstdint>
#include <variant>

namespace orb::vm {

/// The third operand of a roll (Source: LL §Roll Command Parameters).
enum class Go : std::uint8_t {
  Brake = 0,   ///< optimal braking to a stop
  Drive = 1,   ///< normal driving
  FastTurn = 2 ///< turn at the fast rate, whatever the speed
};

/// Which end leads.
enum class Way : std::uint8_t { Ahead, Back };

struct Roll {
  int heading_deg = 0; ///< 0..359: where it faces
  int speed = 0;       ///< 0..255
  Go go = Go::Drive;
  Way way = Way::Ahead;

  friend constexpr bool operator==(const Roll&, const Roll&) = default;
};

/// Modes of a motor (Source: API §Set Raw Motor Values).
enum class MotorMode : std::uint8_t { Off = 0, Forward = 1, Reverse = 2, Brake = 3, Ignore = 4 };

struct Motor {
  MotorMode mode = MotorMode::Off;
  int power = 0; ///< 0..255
};

struct Motors {
  Motor left;
  Motor right;
};

/// Returns true if the motor turns its wheel.
constexpr bool is_on(const Motor& motor) {
  return motor.power != 0 && (motor.mode == MotorMode::Forward || motor.mode == MotorMode::Reverse);
}

/// Modes of the control system. `OnAndReset` also takes the present heading as the set-point.
enum class Stabilization : std::uint8_t { Off = 0, OnAndReset = 1, On = 2 };

/// A turn in place, positive to the right; may exceed a full turn.
struct Rotate {
  int angle_deg = 0;
  Duration time{};
};

/// Renames the present heading (Source: API §Set Heading). The locator has its own rule:
/// Body::set_tare_correction().
struct SetHeading {
  int heading_deg = 0;
};

/// Changes the speed along the present heading (Source: macro 25h).
struct SetSpeed {
  int speed = 0; ///< 0..255
};

/// Sets the rate of ordinary turns.
struct RotationRate {
  double deg_per_s = 0;
};

/// Brakes to a stop, keeps the heading and switches raw motors off.
struct Stop {};

/// Requests to the control system by clients, programs and macros.
using Motion =
    std::variant<Roll, Rotate, Motors, SetHeading, SetSpeed, Stabilization, RotationRate, Stop>;

enum class Switch : std::uint8_t { Off, On };

} // namespace orb::vm
