#include "vm/room/contacts.h"
#include "vm/body/trigonometry.h"

#include "spec/ball.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orb::vm {
namespace {

using namespace spec::ball; // figures of the model

struct Contact {
  IndexPair pair;
  Point normal; ///< from the second to the first
  double depth = 0;
  bool told = false; ///< reported as a knock
};

std::vector<Contact> touching(std::span<const Mover> balls, std::span<const IndexPair> pairs) {
  constexpr double touch = 2 * radius - 1e-9;
  std::vector<Contact> found;
  for (const auto& pair : pairs) {
    const auto& one = balls[pair.first].place;
    const auto& other = balls[pair.second].place;
    const double distance = vm::length(one.x - other.x, one.y - other.y);
    if (distance >= touch)
      continue;
    const Point normal = distance == 0
                             ? Point{1, 0}
                             : Point{(one.x - other.x) / distance, (one.y - other.y) / distance};
    found.push_back({pair, normal, 2 * radius - distance});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.depth > b.depth; });
  return found;
}

void add(Point& to, Point what, double times) {
  to.x += what.x * times;
  to.y += what.y * times;
}

/// Separates two balls that approach each other. Returns true if they did.
bool part(Contact& contact, std::vector<Point>& velocities, std::vector<Shove>& shoves) {
  const auto [first, second] = contact.pair;
  const auto& normal = contact.normal;
  const double approach = (velocities[second].x - velocities[first].x) * normal.x +
                          (velocities[second].y - velocities[first].y) * normal.y;
  constexpr double none = 1e-9; // cm/s: rounding errors
  if (approach <= none)
    return false;
  const bool hard = approach >= least_blow;
  const double gained = approach * (hard ? 1 + ball_restitution : 1) / 2;
  for (const auto& [ball, sign] : {std::pair{first, 1.0}, std::pair{second, -1.0}}) {
    add(velocities[ball], normal, sign * gained);
    add(shoves[ball].change, normal, sign * gained);
  }
  if (hard && !std::exchange(contact.told, true)) {
    // Each feels half the closing speed: two that meet at the same speed feel a wall.
    const Point into{normal.x * approach / 2, normal.y * approach / 2};
    shoves[first].knocks.push_back({second, {-into.x, -into.y}});
    shoves[second].knocks.push_back({first, into});
  }
  return true;
}

} // namespace

std::vector<Shove> contacts(std::span<const Mover> balls, std::span<const IndexPair> pairs) {
  std::vector<Shove> shoves(balls.size());
  auto found = touching(balls, pairs);
  if (found.empty())
    return shoves;
  std::vector<Point> velocities(balls.size());
  std::transform(balls.begin(), balls.end(), velocities.begin(),
                 [](const Mover& ball) { return ball.velocity; });
  constexpr int most_rounds = 8; // separating one contact may close the next
  for (int round = 0, parted = 1; parted != 0 && round < most_rounds; ++round) {
    parted = 0;
    for (auto& contact : found)
      parted += part(contact, velocities, shoves) ? 1 : 0;
  }
  for (const auto& contact : found) {
    add(shoves[contact.pair.first].shift, contact.normal, contact.depth / 2);
    add(shoves[contact.pair.second].shift, contact.normal, -contact.depth / 2);
  }
  return shoves;
}

} // namespace orb::vm
