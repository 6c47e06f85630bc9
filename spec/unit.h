#pragma once

// The value of one step, parsed from its unit: `0.1 deg/s`, `1/4096 G`, `cm`.

#include <string_view>

namespace orb::spec {

/// Steps per unit: 10 for `0.1 deg/s`, 4096 for `1/4096 G`, 1 for `cm`. Kept as a fraction, so that
/// decimal steps stay exact.
struct Scale {
  double steps = 1;
  double per = 1;

  constexpr double of(double value) const { return value * steps / per; }
  /// Converts steps back to the unit.
  constexpr double back(double number) const { return number * per / steps; }
};

constexpr Scale scale_of(std::string_view unit) {
  const auto take = [&] {
    double number = 0;
    while (!unit.empty() && unit.front() >= '0' && unit.front() <= '9') {
      number = number * 10 + (unit.front() - '0');
      unit.remove_prefix(1);
    }
    return number;
  };
  if (unit.empty() || unit.front() < '0' || unit.front() > '9')
    return {};
  Scale scale;
  scale.per = take();
  if (unit.starts_with('/')) {
    unit.remove_prefix(1);
    scale.steps = take();
  } else if (unit.starts_with('.')) {
    unit.remove_prefix(1);
    while (!unit.empty() && unit.front() >= '0' && unit.front() <= '9') {
      scale.per = scale.per * 10 + (unit.front() - '0');
      scale.steps *= 10;
      unit.remove_prefix(1);
    }
  }
  return scale;
}

} // namespace orb::spec
