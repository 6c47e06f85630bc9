#pragma once

#include "base/time.h"
#include "spec/ball.h"
#include "vm/body/place.h"

#include <optional>

namespace orb::vm {

/// Tells a double shake from the samples of an accelerometer: it is jerked to one side and, within
/// the time that a shake of the virtual ball lasts, to the other.
class ShakeSense {
public:
  /// A sample, in g, at an instant. Whether a double shake has just been completed.
  bool feel(const Vector3& felt_g, Instant now) {
    constexpr double jerk_g = spec::ball::shake_g / 2; // that it lies still adds 1 g at most
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

  std::optional<Vector3> jerk_; ///< the last
  Instant at_{};
};

} // namespace orb::vm
