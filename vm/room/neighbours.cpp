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

  friend bool operator==(Cell, Cell) = default;
};

/// The cells of a grid in as many buckets as there are places, or twice that; cells may share one.
class Grid {
public:
  Grid(std::span<const Point> places, double size)
      : buckets_(std::bit_ceil(places.size() + 1)), first_(buckets_ + 1), cells_(places.size()),
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

  /// Calls `take` with those after `i` in its cell and the eight around it.
  template <class Take>
  void around(std::size_t i, Take take) const {
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const Cell cell{cells_[i].x + dx, cells_[i].y + dy};
        const auto b = bucket(cell);
        for (auto at = first_[b]; at < first_[b + 1]; ++at)
          if (const auto j = sorted_[at]; j > i && cells_[j] == cell)
            take(j);
      }
  }

private:
  std::size_t bucket(Cell cell) const {
    constexpr std::uint64_t odd_x = 0x9E3779B97F4A7C15; // spreads neighbours: the golden ratio
    constexpr std::uint64_t odd_y = 0xC2B2AE3D27D4EB4F; // another odd number without a pattern
    constexpr int half = 32;
    const auto mixed =
        static_cast<std::uint64_t>(cell.x) * odd_x + static_cast<std::uint64_t>(cell.y) * odd_y;
    return static_cast<std::size_t>(mixed >> half) & (buckets_ - 1);
  }

  std::size_t buckets_;
  std::vector<std::size_t> first_; ///< of each bucket in `sorted_`
  std::vector<Cell> cells_;
  std::vector<std::size_t> sorted_;
};

} // namespace

std::vector<Pair> neighbours(std::span<const Point> places, double distance_cm) {
  std::vector<Pair> pairs;
  const Grid grid(places, distance_cm);
  for (std::size_t i = 0; i < places.size(); ++i)
    grid.around(i, [&](std::size_t j) {
      const double dx = places[i].x - places[j].x;
      const double dy = places[i].y - places[j].y;
      if (dx * dx + dy * dy <= distance_cm * distance_cm)
        pairs.push_back({i, j});
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace orb::vm
