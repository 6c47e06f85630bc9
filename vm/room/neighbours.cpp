#include "vm/room/neighbours.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace orb::vm {
namespace {

struct Cell {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// Grid cells hashed into about as many buckets as there are places; cells may share one.
/// Vertically adjacent cells are in adjacent buckets.
class Grid {
public:
  Grid(std::span<const Point> places, double size)
      : buckets_(std::bit_ceil(places.size() + 3)), first_(buckets_ + 1), cells_(places.size()),
        sorted_(places.size()) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      cells_[i] = {static_cast<std::int64_t>(std::floor(places[i].x / size)),
                   static_cast<std::int64_t>(std::floor(places[i].y / size))};
      ++first_[bucket(cells_[i]) + 1];
    }
    for (std::size_t b = 0; b < buckets_; ++b)
      first_[b + 1] += first_[b];
    auto next = first_;
    for (std::size_t i = 0; i < places.size(); ++i)
      sorted_[next[bucket(cells_[i])]++] = i;
  }

  /// Calls `take` with the places in the cell of `i` and around it, so that each pair comes once:
  /// those of its column after `i`, and all of the next column.
  template <class Take>
  void around(std::size_t i, Take take) const {
    const auto& [x, y] = cells_[i];
    for (const auto column : {x, x + 1}) {
      const auto below = bucket({column, y - 1});
      for (std::size_t row = 0; row < 3; ++row) {
        const auto b = (below + row) & (buckets_ - 1);
        for (auto at = first_[b]; at < first_[b + 1]; ++at)
          if (const auto j = sorted_[at]; cells_[j].x == column && (column != x || j > i))
            take(j);
      }
    }
  }

private:
  std::size_t bucket(Cell cell) const {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15; // spreads columns: the golden ratio
    constexpr int half = 32;
    const auto column = (static_cast<std::uint64_t>(cell.x) * odd) >> half;
    return static_cast<std::size_t>(column + static_cast<std::uint64_t>(cell.y)) & (buckets_ - 1);
  }

  std::size_t buckets_;            ///< a power of two, at least four
  std::vector<std::size_t> first_; ///< start of each bucket in `sorted_`
  std::vector<Cell> cells_;
  std::vector<std::size_t> sorted_;
};

} // namespace

std::vector<IndexPair> neighbours(std::span<const Point> places, double distance_cm) {
  std::vector<IndexPair> pairs;
  const Grid grid(places, distance_cm);
  for (std::size_t i = 0; i < places.size(); ++i)
    grid.around(i, [&](std::size_t j) {
      const double dx = places[i].x - places[j].x;
      const double dy = places[i].y - places[j].y;
      if (dx * dx + dy * dy <= distance_cm * distance_cm)
        pairs.push_back({std::min(i, j), std::max(i, j)});
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace orb::vm
