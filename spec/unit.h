#pragma once

// What one step of a number is worth, read from its unit: `0.1 deg/s`, `1/4096 G`, `cm`.

#include <string_view>

namespace orb::spec {

/// How many steps of `unit` are one of what it counts: 10 for `0.1 deg/s`, 4096 for `1/4096 G`, 1
/// for `cm`. A fraction, so that a step which is no binary number loses nothing.
struct Scale {
  double steps = 1;
  double per = 1;

  constexpr double of(double value) const { return value * steps / per; }
  /// The other way: what so many steps are.
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
