#pragma once

#include "base/time.h"

#include <cstdint>
#include <variant>

namespace orb::vm {

/// The third value of a roll (Source: LL §Roll Command Parameters).
enum class Go : std::uint8_t {
  Brake = 0,   ///< optimal braking to a stop
  Drive = 1,   ///< normal driving
  FastTurn = 2 ///< turn at the fast rate at any speed
};

struct Roll {
  int heading_deg = 0; ///< 0..359
  int speed = 0;       ///< 0..255
  Go go = Go::Drive;

  friend constexpr bool operator==(const Roll&, const Roll&) = default;
};

/// What a motor does (Source: API §Set Raw Motor Values).
enum class MotorMode : std::uint8_t { Off = 0, Forward = 1, Reverse = 2, Brake = 3, Ignore = 4 };

struct Motor {
  MotorMode mode = MotorMode::Off;
  int power = 0; ///< 0..255
};

struct Motors {
  Motor left;
  Motor right;
};

/// Whether a motor that is set so turns its wheel.
constexpr bool is_on(const Motor& motor) {
  return motor.power != 0 && (motor.mode == MotorMode::Forward || motor.mode == MotorMode::Reverse);
}

/// The control system. `OnAndReset` also takes the present heading as the set-point.
enum class Stabilization : std::uint8_t { Off = 0, OnAndReset = 1, On = 2 };

/// Positive to the right; more than one turn is possible.
struct Rotate {
  int angle_deg = 0;
  Duration time{};
};

/// Renames the present heading (Source: API §Set Heading); the locator follows its own rule.
struct SetHeading {
  int heading_deg = 0;
};

/// Another speed along the present heading (Source: macro 25h).
struct SetSpeed {
  int speed = 0; ///< 0..255
};

/// The rate of an ordinary turn.
struct RotationRate {
  double deg_per_s = 0;
};

/// Brakes to a stop and keeps the heading; motors that were set go off.
struct Stop {};

/// What clients, programs and macros ask of the control system.
using Motion =
    std::variant<Roll, Rotate, Motors, SetHeading, SetSpeed, Stabilization, RotationRate, Stop>;

enum class Switch : std::uint8_t { Off, On };

} // namespace orb::vm
