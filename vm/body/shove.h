#pragma once

#include "vm/body/place.h"

#include <cstddef>
#include <vector>

namespace orb::vm {

/// A ball in its world as other balls meet it: cm and cm/s.
struct Mover {
  Point place;
  Point velocity;
};

/// A blow by another ball: the part of the velocity that goes into it, as if it were a wall, cm/s.
struct Knock {
  std::size_t other = 0; ///< index of the other ball
  Point into;
};

/// The effect of other balls on one ball at an instant. All balls have the same mass.
struct Shove {
  Point change; ///< change of its velocity, cm/s
  Point shift;  ///< shift out of the other balls, cm
  std::vector<Knock> knocks;
};

} // namespace orb::vm
