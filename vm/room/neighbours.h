#pragma once

#include "vm/body/place.h"

#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace orb::vm {

/// Two indexes of a list, the smaller first.
struct IndexPair {
  std::size_t first = 0;
  std::size_t second = 0;

  friend auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// Returns the pairs of places at most `distance_cm` apart, in order. Uses a uniform grid: O(n) if
/// few places share a cell.
std::vector<IndexPair> neighbours(std::span<const Point> places, double distance_cm);

} // namespace orb::vm
