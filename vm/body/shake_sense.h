#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "vm/body/place.h"

#include <optional>

namespace orb::vm {

/// Detects a double shake in accelerometer samples: a jerk to one side and, within the time that a
/// shake of the virtual ball lasts, one to the other.
class ShakeSense {
public:
  /// Takes a sample in g. Returns true if it completes a double shake.
  bool feel(const Vector3& felt_g, Instant now) {
    constexpr double jerk_g = spec::ball::shake_g / 2; // gravity adds at most 1 g
    if (felt_g.x * felt_g.x + felt_g.y * felt_g.y + felt_g.z * felt_g.z <
        (1 + jerk_g) * (1 + jerk_g))
      return false;
    const bool back = jerk_ && now - at_ <= spec::ball::shake_time && dot(*jerk_, felt_g) < 0;
    jerk_ = felt_g;
    at_ = now;
    return back;
  }

private:
  static double dot(const Vector3& a, const Vector3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  std::optional<Vector3> jerk_; ///< the last jerk
  Instant at_{};
};

} // namespace orb::vm
