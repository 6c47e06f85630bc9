#include "report/course.h"

#include "base/text/text.h"

#include <algorithm>
#include <cmath>

namespace orb::report {
namespace {

/// Returns the winding number of a polygon around a place, by counting crossings to the right of
/// it.
int winding(const std::vector<vm::Point>& ring, vm::Point place) {
  int turns = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& from = ring[i];
    const auto& to = ring[i + 1 == ring.size() ? 0 : i + 1];
    if ((from.y <= place.y) == (to.y <= place.y))
      continue;
    const double across =
        (to.x - from.x) * (place.y - from.y) - (place.x - from.x) * (to.y - from.y);
    if (from.y <= place.y && across > 0)
      ++turns;
    if (to.y <= place.y && across < 0)
      --turns;
  }
  return turns;
}

} // namespace

void Box::include(vm::Point place) {
  low = {std::min(low.x, place.x), std::min(low.y, place.y)};
  high = {std::max(high.x, place.x), std::max(high.y, place.y)};
}

bool Zone::contains(vm::Point place) const {
  if (place.x < box.low.x || place.x > box.high.x || place.y < box.low.y || place.y > box.high.y)
    return false;
  if (ellipse) {
    const vm::Point way{place.x - ellipse->middle.x, place.y - ellipse->middle.y};
    return std::hypot(way.x * ellipse->to_x.x + way.y * ellipse->to_x.y,
                      way.x * ellipse->to_y.x + way.y * ellipse->to_y.y) <= 1;
  }
  int turns = 0;
  for (const auto& ring : rings)
    turns += winding(ring, place);
  return fill == Fill::EvenOdd ? turns % 2 != 0 : turns != 0;
}

double Zone::distance_cm(vm::Point place) const {
  if (contains(place))
    return 0;
  double least = HUGE_VAL;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto edge = vm::Wall::between(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
      const auto foot = vm::nearest_point(edge, place);
      least = std::min(least, std::hypot(place.x - foot.x, place.y - foot.y));
    }
  return least;
}

const Zone* Course::zone(std::string_view id) const {
  const auto found =
      std::find_if(zones.begin(), zones.end(), [&](const Zone& zone) { return zone.id == id; });
  return found == zones.end() ? nullptr : &*found;
}

Box Course::box() const {
  Box around;
  for (const auto& wall : walls) {
    around.include(wall.from);
    around.include(wall.to);
  }
  for (const auto& zone : zones) {
    around.include(zone.box.low);
    around.include(zone.box.high);
  }
  return around;
}

std::vector<vm::TimedStimulus> Course::stimuli() const {
  std::vector<vm::TimedStimulus> events;
  for (const auto& wall : walls)
    events.push_back({Duration{}, wall});
  return events;
}

bool is_course(std::string_view file_name) {
  return file_name.size() > course_ending.size() && has_ending(file_name, course_ending);
}

} // namespace orb::report
