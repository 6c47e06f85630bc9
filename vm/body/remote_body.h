#pragma once

#include "vm/body/motion.h"
#include "vm/body/place.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend constexpr bool operator==(Color, Color) = default;
};

/// A sensor sample of a remote robot, in its own axes: y is where it faced when the run began, x is
/// to the right of that; yaw grows clockwise.
struct Sample {
  Point place_cm;
  Vector3 velocity_cm_s;
  double yaw_deg = 0; ///< 0 <= yaw < 360
  double pitch_deg = 0;
  double roll_deg = 0;
  Vector3 acceleration_g{0, 0, 1};
  Vector3 rotation_deg_s;
  std::optional<Quaternion> attitude; ///< nullopt: derived from yaw, pitch and roll at rest
};

/// A remote robot that serves as a ball's body: it takes set-points and colours. Its samples come
/// back through Ball::feel().
class RemoteBody {
public:
  virtual ~RemoteBody() = default;
  /// Headings are in the robot's own axes; a change of speed arrives as a roll.
  virtual void obey(const Motion& motion) = 0;
  virtual void show(Color color) = 0;
  virtual void show_back(int level) = 0; ///< 0..255
};

} // namespace orb::vm
