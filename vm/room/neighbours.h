#pragma once

#include "vm/body/place.h"

#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace orb::vm {

/// Two of a list, the first one's place being the smaller.
struct Pair {
  std::size_t first = 0;
  std::size_t second = 0;

  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// The pairs of places that are at most `distance_cm` apart, in order. It looks into the cells of a
/// uniform grid: O(n) where few places share a cell.
std::vector<Pair> neighbours(std::span<const Point> places, double distance_cm);

} // namespace orb::vm
