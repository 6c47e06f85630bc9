#pragma once

// The ball itself in numbers. The rows are in spec/ball.def.

#include <array>
#include <chrono>
#include <string_view>

namespace orb::spec {

namespace ball {
using ms = std::chrono::milliseconds;
#define BALL(type, name, value, unit, source, summary) inline constexpr type name{value};
#include "spec/ball.def"
#undef BALL
} // namespace ball

struct BallNumber {
  std::string_view name; ///< the constant's
  double value;
  std::string_view unit; ///< may be empty
  std::string_view source;
  std::string_view summary;
};

/// The same numbers as rows.
inline constexpr auto ball_numbers = std::to_array<BallNumber>({
#define BALL(type, name, value, unit, source, summary) {#name, value, unit, source, summary},
#include "spec/ball.def"
#undef BALL
});

} // namespace orb::spec
