#include "report/svg.h"

#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace orb::report {
namespace {

constexpr double card_width = 480;
constexpr double card_height_max = 480;
constexpr double card_height_min = 200;
constexpr double margin = 44;
constexpr double least_span_cm = 20;

struct Point {
  double x = 0;
  double y = 0;
};

/// Maps centimetres (y up) to the card (y down).
struct CardTransform {
  double scale = 1;
  Point origin; ///< the place of 0,0 on the card
  double height = card_width;

  Point operator()(vm::Point place) const {
    return {origin.x + place.x * scale, origin.y - place.y * scale};
  }
  Point operator()(const vm::Pose& pose) const { return (*this)(vm::Point{pose.x_cm, pose.y_cm}); }
};

/// Rounds to a tenth of a unit, without a sign before zero: enough for a drawing, and equal on
/// every machine.
std::string number(double value) {
  const auto tenths = std::llround(value * 10);
  if (tenths % 10 == 0)
    return std::to_string(tenths / 10);
  return fmt::format("{}{}.{}", tenths < 0 ? "-" : "", std::abs(tenths / 10),
                     std::abs(tenths % 10));
}

std::string at(Point point) {
  return number(point.x) + " " + number(point.y);
}

std::string color_name(vm::Color color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

bool lit(vm::Color color) {
  return !(color == vm::Color{});
}

vm::Color color_at(const Journey& journey, Duration t) {
  const auto& entries = journey.led().entries();
  const auto after =
      std::upper_bound(entries.begin(), entries.end(), t,
                       [](Duration when, const auto& entry) { return when < entry.t; });
  return after == entries.begin() ? vm::Color{} : std::prev(after)->value;
}

/// Returns the last colour that was not black; a program's end turns the light off.
vm::Color last_lit(const Journey& journey) {
  const auto& entries = journey.led().entries();
  const auto found = std::find_if(entries.rbegin(), entries.rend(),
                                  [](const auto& entry) { return lit(entry.value); });
  return found == entries.rend() ? vm::Color{} : found->value;
}

struct Extent {
  double left = 0;
  double right = 0;
  double low = 0;
  double high = 0;
};

/// Bounding box of a journey, and of another one that may be null.
Extent extent(const Journey& journey, const Journey* other) {
  Extent box;
  bool first = true;
  for (const auto* one : {&journey, other}) {
    if (one == nullptr)
      continue;
    for (const auto& entry : one->poses().entries()) {
      const auto& pose = entry.value;
      if (first)
        box = {pose.x_cm, pose.x_cm, pose.y_cm, pose.y_cm};
      first = false;
      box.left = std::min(box.left, pose.x_cm);
      box.right = std::max(box.right, pose.x_cm);
      box.low = std::min(box.low, pose.y_cm);
      box.high = std::max(box.high, pose.y_cm);
    }
  }
  return box;
}

/// Draws one line through all places.
std::string pale_path(const Journey& journey, const CardTransform& to_card) {
  std::string d;
  std::string here;
  for (const auto& entry : journey.poses().entries())
    if (const auto next = at(to_card(entry.value)); next != here) {
      d += (d.empty() ? "M" : "L") + next;
      here = next;
    }
  return fmt::format("<path class=\"planned\" d=\"{}\"/>\n", d);
}

/// Extends the box to include the course.
Extent with_course(Extent box, const Course& course) {
  const auto around = course.box();
  return {std::min(box.left, around.low.x), std::max(box.right, around.high.x),
          std::min(box.low, around.low.y), std::max(box.high, around.high.y)};
}

bool moved(const Extent& box) {
  return box.right - box.left > 1 || box.high - box.low > 1;
}

CardTransform card_transform(const Extent& box) {
  const double wide = std::max(box.right - box.left, least_span_cm);
  const double tall = std::max(box.high - box.low, least_span_cm);
  CardTransform to_card;
  to_card.scale = std::min((card_width - 2 * margin) / wide, (card_height_max - 2 * margin) / tall);
  to_card.height =
      std::clamp(std::ceil(tall * to_card.scale + 2 * margin), card_height_min, card_height_max);
  to_card.origin = {card_width / 2 - (box.left + box.right) / 2 * to_card.scale,
                    to_card.height / 2 + (box.low + box.high) / 2 * to_card.scale};
  return to_card;
}

/// Returns 1, 2 or 5 times a power of ten, so that grid lines are at least 40 units apart.
double grid_step_cm(double scale) {
  double power = 1;
  while (power * scale * 10 < 40)
    power *= 10;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * scale >= 40)
      return factor * power;
  return 10 * power;
}

std::string grid(const CardTransform& to_card) {
  const double step = grid_step_cm(to_card.scale);
  std::string d;
  const auto first_x = std::lround(std::ceil(-to_card.origin.x / to_card.scale / step));
  const auto last_x =
      std::lround(std::floor((card_width - to_card.origin.x) / to_card.scale / step));
  for (auto n = first_x; n <= last_x; ++n)
    d += fmt::format("M{} 0V{}",
                     number(to_card.origin.x + static_cast<double>(n) * step * to_card.scale),
                     number(to_card.height));
  const auto first_y =
      std::lround(std::ceil((to_card.origin.y - to_card.height) / to_card.scale / step));
  const auto last_y = std::lround(std::floor(to_card.origin.y / to_card.scale / step));
  for (auto n = first_y; n <= last_y; ++n)
    d += fmt::format("M0 {}H{}",
                     number(to_card.origin.y - static_cast<double>(n) * step * to_card.scale),
                     number(card_width));
  const double length = step * to_card.scale;
  const auto words = step >= 100 ? fmt::format("{:g} m", step / 100) : fmt::format("{:g} cm", step);
  return fmt::format("<path class=\"grid\" d=\"{}\"/>\n"
                     "<path class=\"scale\" d=\"M{} {}v5h{}v-5\"/>\n"
                     "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     d, number(card_width - 14 - length), number(to_card.height - 17),
                     number(length), number(card_width - 14 - length / 2),
                     number(to_card.height - 20), words);
}

std::string draw_walls(const Journey& journey, const CardTransform& to_card) {
  std::string out;
  for (const auto& wall : journey.walls()) {
    if (wall.axis == vm::Wall::Axis::None)
      out += fmt::format("<path class=\"wall\" d=\"M{}L{}\"/>\n", at(to_card(wall.from)),
                         at(to_card(wall.to)));
    else if (wall.axis == vm::Wall::Axis::X)
      out += fmt::format("<path class=\"wall\" d=\"M{} 0V{}\"/>\n",
                         number(to_card.origin.x + wall.at_cm * to_card.scale),
                         number(to_card.height));
    else
      out += fmt::format("<path class=\"wall\" d=\"M0 {}H{}\"/>\n",
                         number(to_card.origin.y - wall.at_cm * to_card.scale), number(card_width));
  }
  return out;
}

std::string zones(const Course& course, const CardTransform& to_card) {
  std::string out;
  for (const auto& zone : course.zones) {
    std::string d;
    for (const auto& ring : zone.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        d += (i == 0 ? "M" : "L") + at(to_card(ring[i]));
      d += "z";
    }
    const auto top = to_card(vm::Point{(zone.box.low.x + zone.box.high.x) / 2, zone.box.high.y});
    out += fmt::format("<path class=\"zone\"{} d=\"{}\"/>\n"
                       "<text class=\"zone-name\" x=\"{}\" y=\"{}\" "
                       "text-anchor=\"middle\">{}</text>\n",
                       zone.fill == Zone::Fill::EvenOdd ? " fill-rule=\"evenodd\"" : "", d,
                       number(top.x), number(top.y + 15), escape_markup(zone.id));
  }
  return out;
}

std::string path(const Journey& journey, const CardTransform& to_card) {
  const auto& poses = journey.poses().entries();
  std::string outline;
  std::string unlit;
  std::string out; // lit stretches are drawn above unlit ones
  std::string open;
  vm::Color color;
  std::string here;
  const auto close = [&] {
    if (open.empty())
      return;
    if (lit(color)) {
      outline += open;
      out +=
          fmt::format("<path class=\"path\" stroke=\"{}\" d=\"{}\"/>\n", color_name(color), open);
    } else {
      unlit += fmt::format("<path class=\"path unlit\" d=\"{}\"/>\n", open);
    }
    open.clear();
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto next = at(to_card(poses[i].value));
    if (i > 0 && next != here) {
      const auto shows = color_at(journey, poses[i - 1].t);
      if (open.empty() || !(shows == color)) {
        close();
        open = "M" + here;
        color = shows;
      }
      open += "L" + next;
    }
    here = next;
  }
  close();
  if (!outline.empty())
    unlit += fmt::format("<path class=\"outline\" d=\"{}\"/>\n", outline);
  return unlit + out;
}

std::string marks(const Journey& journey, const CardTransform& to_card) {
  std::string out;
  for (const auto& happening : journey.listed().happenings) {
    if (!happening.at)
      continue;
    const auto where = to_card(*happening.at);
    if (happening.kind == Happening::Kind::Collision)
      out += fmt::format("<path class=\"hit\" d=\"M{}l10 10m0 -10l-10 10\"/>\n",
                         at({where.x - 5, where.y - 5}));
    if (happening.kind == Happening::Kind::Marker)
      out += fmt::format("<path class=\"marker\" d=\"M{}l6 6l-6 6l-6 -6z\"/>\n",
                         at({where.x, where.y - 6}));
    if (happening.kind == Happening::Kind::Error)
      out +=
          fmt::format("<path class=\"fault\" d=\"M{}l8 14h-16z\"/>\n", at({where.x, where.y - 8}));
  }
  return out;
}

std::string ball(Point where, double radius, vm::Color color) {
  const auto x = number(where.x);
  const auto y = number(where.y);
  auto out =
      fmt::format("<circle class=\"ball\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", x, y, number(radius));
  if (lit(color))
    out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", x, y,
                       number(radius - 1), color_name(color));
  return out + fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"url(#shine)\"/>\n", x, y,
                           number(radius));
}

/// Returns a point on a circle around `center`; share 0 is the top, 1 a full turn clockwise.
Point on_circle(Point center, double radius, double share) {
  const double angle = share * 2 * 3.14159265358979323846;
  return {center.x + radius * std::sin(angle), center.y - radius * std::cos(angle)};
}

/// Draws the colours over time as a ring, for a ball that stayed in place.
std::string ring(const Journey& journey, Point center, double radius) {
  const auto& entries = journey.led().entries();
  const auto end = std::max(journey.end().t, Duration{1});
  auto out = fmt::format("<circle class=\"ring\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n",
                         number(center.x), number(center.y), number(radius));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!lit(entries[i].value) || entries[i].t >= end)
      continue;
    const auto until = i + 1 < entries.size() ? std::min(entries[i + 1].t, end) : end;
    const double from =
        static_cast<double>(entries[i].t.count()) / static_cast<double>(end.count());
    const double to = static_cast<double>(until.count()) / static_cast<double>(end.count());
    const auto first = at(on_circle(center, radius, from));
    // Two halves, because an arc cannot be a full circle.
    const auto middle = at(on_circle(center, radius, (from + to) / 2));
    const auto last = at(on_circle(center, radius, to));
    if (first == last && to - from < 0.5)
      continue;
    out += fmt::format(
        "<path class=\"arc\" stroke=\"{0}\" d=\"M{1}A{4} {4} 0 0 1 {2}A{4} {4} 0 0 1 {3}\"/>\n",
        color_name(entries[i].value), first, middle, last, number(radius));
  }
  return out + fmt::format("<path class=\"scale\" d=\"M{}v-20\"/>\n",
                           at({center.x, center.y - radius + 10}));
}

constexpr std::string_view style = R"(<style>
.card{fill:#fbfdfe}.grid{stroke:#dfe8ee;fill:none}.scale{stroke:#14212b;stroke-width:1.5;fill:none}
text{font:600 11px system-ui,sans-serif;fill:#14212b}.wall{stroke:#536472;stroke-width:4}
.path,.outline{fill:none;stroke-linecap:round;stroke-linejoin:round;stroke-width:3.5}
.outline{stroke:#14212b;stroke-opacity:.5;stroke-width:5.5}.unlit{stroke:#8c9ba7}
.start{fill:none;stroke:#14212b;stroke-width:2}.hit{stroke:#b3261e;stroke-width:2.4;fill:none}
.marker{fill:#fbfdfe;stroke:#14212b;stroke-width:1.6}.fault{fill:#b3261e}
.ball{fill:#d9e2e8;stroke:#5d6e7b;stroke-width:1.5}.ring,.arc{fill:none;stroke-width:16}.ring{stroke:#dfe8ee}
@media (prefers-color-scheme:dark){.card{fill:#10171d}.grid,.ring{stroke:#1e2a34}.scale,.start{stroke:#e4ecf1}
text{fill:#e4ecf1}.wall{stroke:#91a2af}.outline{stroke:#000}.unlit{stroke:#586a77}.hit{stroke:#ff8a7f}
.marker{fill:#10171d;stroke:#e4ecf1}.fault{fill:#ff8a7f}.ball{fill:#26333d;stroke:#7b8d9a}}
</style>
<defs><radialGradient id="shine" cx=".36" cy=".3" r=".75"><stop offset="0" stop-color="#fff" stop-opacity=".85"/><stop offset=".45" stop-color="#fff" stop-opacity=".1"/><stop offset="1" stop-color="#000" stop-opacity=".25"/></radialGradient></defs>
)";

/// For pictures with a course.
constexpr std::string_view zone_style = R"(<style>
.wall{stroke-linecap:round}.zone{fill:#1d5fd1;fill-opacity:.1;stroke:#1d5fd1;stroke-dasharray:5 4}.zone-name{fill:#1d5fd1}
@media (prefers-color-scheme:dark){.zone{fill:#7db0ff;stroke:#7db0ff}.zone-name{fill:#7db0ff}}
</style>
)";

/// For pictures with a planned path.
constexpr std::string_view planned_style = R"(<style>
.planned{fill:none;stroke:#8c9ba7;stroke-opacity:.45;stroke-width:9;stroke-linecap:round;stroke-linejoin:round}
</style>
)";

std::string picture(const Journey& journey, const Journey* planned, double* height) {
  auto box = extent(journey, planned);
  const auto& poses = journey.poses().entries();
  const auto last = last_lit(journey);
  const auto& course = journey.course();
  if (course)
    box = with_course(box, *course);
  else if (!moved(box)) {
    *height = 240;
    const Point center{card_width / 2, *height / 2};
    return ring(journey, center, 78) + ball(center, 44, last);
  }
  const auto to_card = card_transform(box);
  *height = to_card.height;
  const auto start = poses.empty() ? to_card(vm::Point{}) : to_card(poses.front().value);
  const auto end = poses.empty() ? start : to_card(poses.back().value);
  return grid(to_card) + (course ? zones(*course, to_card) : std::string()) +
         draw_walls(journey, to_card) +
         (planned != nullptr ? pale_path(*planned, to_card) : std::string()) +
         path(journey, to_card) +
         fmt::format("<circle class=\"start\" cx=\"{}\" cy=\"{}\" r=\"8\"/>\n", number(start.x),
                     number(start.y)) +
         marks(journey, to_card) + ball(end, 10, last);
}

/// Bounding box of all balls and the course.
Extent extent_of(std::span<const RoomRun> balls) {
  Extent box;
  bool first = true;
  for (const auto& one : balls) {
    const auto own = extent(*one.journey, nullptr);
    box = first ? own
                : Extent{std::min(box.left, own.left), std::max(box.right, own.right),
                         std::min(box.low, own.low), std::max(box.high, own.high)};
    first = false;
  }
  const auto& course = balls.front().journey->course();
  return course ? with_course(box, *course) : box;
}

/// Draws a ball of a room with its name.
std::string named_ball(const RoomRun& one, const CardTransform& to_card) {
  constexpr double least_radius = 4;
  constexpr double most_radius = 20;
  const auto& poses = one.journey->poses().entries();
  const auto where = poses.empty() ? to_card(vm::Point{}) : to_card(poses.back().value);
  const double radius = std::clamp(spec::ball::radius * to_card.scale, least_radius, most_radius);
  return ball(where, radius, last_lit(*one.journey)) +
         fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", number(where.x),
                     number(where.y - radius - 4), escape_markup(to_valid_utf8(one.name)));
}

std::string room_picture(std::span<const RoomRun> balls, double* height) {
  const auto to_card = card_transform(extent_of(balls));
  *height = to_card.height;
  const auto& first = *balls.front().journey;
  auto out = grid(to_card) + (first.course() ? zones(*first.course(), to_card) : std::string()) +
             draw_walls(first, to_card);
  for (const auto& one : balls)
    out += path(*one.journey, to_card);
  for (const auto& one : balls)
    out += named_ball(one, to_card);
  return out;
}

std::string card(const std::string& body, double height, std::string_view more_style) {
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
                     "width=\"{0}\" height=\"{1}\" role=\"img\">\n{2}{4}"
                     "<rect class=\"card\" width=\"{0}\" height=\"{1}\" rx=\"10\"/>\n{3}</svg>\n",
                     number(card_width), number(height), style, body, more_style);
}

} // namespace

std::string path_svg(const Journey& journey, const Journey* planned) {
  double height = 0;
  const auto body = picture(journey, planned, &height);
  return card(body, height,
              fmt::format("{}{}", journey.course() ? zone_style : "",
                          planned != nullptr ? planned_style : ""));
}

std::string room_svg(std::span<const RoomRun> balls) {
  double height = 0;
  const auto body = room_picture(balls, &height);
  return card(body, height, balls.front().journey->course() ? zone_style : "");
}

} // namespace orb::report
