#pragma once

#include "vm/body/place.h"

#include <cstddef>
#include <vector>

namespace orb::vm {

/// A ball in its world as others meet it: cm and cm/s.
struct Mover {
  Point place;
  Point velocity;
};

/// A blow by another ball: the part of the speed that goes into it, as if it were a wall, cm/s.
struct Knock {
  std::size_t other = 0; ///< its place among the balls
  Point into;
};

/// What other balls do to one at an instant. All balls weigh the same.
struct Shove {
  Point change; ///< of its velocity, cm/s
  Point shift;  ///< out of the others, cm
  std::vector<Knock> knocks;
};

} // namespace orb::vm
