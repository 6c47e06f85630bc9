#include "report/course_reader.h"

namespace orb::report {

namespace {

constexpr std::size_t most_points = 10'000; // of all lines together, and so of walls
constexpr double farthest_cm = 100'000;

/// Rounds to a millionth of a centimetre, which removes rounding errors of transforms.
double rounded_cm(double cm) {
  return std::round(cm * 1e6) / 1e6 + 0.0;
}

/// Returns true if a ring encloses no area: every triangle of its first point and two successive
/// points is flat.
bool is_flat(const std::vector<Point>& ring) {
  constexpr double least = 1e-9; // square centimetres
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Point first{ring[i].x - ring[0].x, ring[i].y - ring[0].y};
    const Point second{ring[i + 1].x - ring[0].x, ring[i + 1].y - ring[0].y};
    if (std::abs(first.x * second.y - first.y * second.x) > least)
      return false;
  }
  return true;
}

} // namespace

std::optional<Outlines> CourseReader::outlines(const Element& element) {
  const auto& node = element.node;
  if (element.name == "line")
    return Outlines{
        {{{{number(node, "x1"), number(node, "y1")}, {number(node, "x2"), number(node, "y2")}},
          false}},
        {},
        {}};
  if (element.name == "polyline" || element.name == "polygon")
    return points(element);
  if (element.name == "rect")
    return rectangle(element);
  if (element.name == "path") {
    auto path = svg::read_path(node.attribute("d").value(), most_points);
    tell(node, "d", path.mistake);
    return path;
  }
  return std::nullopt;
}

std::optional<Outlines> CourseReader::points(const Element& element) {
  const auto numbers = attribute_numbers(element.node, "points");
  if (numbers.size() % 2 != 0)
    say(rules::CourseValue, place(element.node, "points"), texts::OddPoints());
  Outline line;
  for (std::size_t i = 0; i + 1 < numbers.size() && i < 2 * most_points; i += 2)
    line.points.push_back({numbers[i], numbers[i + 1]});
  line.closed = element.name == "polygon";
  return Outlines{{std::move(line)}, {}, {}};
}

std::optional<Outlines> CourseReader::rectangle(const Element& element) {
  const auto& node = element.node;
  const double x = number(node, "x");
  const double y = number(node, "y");
  const double wide = number(node, "width");
  const double tall = number(node, "height");
  const double given = std::max(number(node, "rx"), number(node, "ry"));
  const double round = std::clamp(given, 0.0, std::max(0.0, std::min(wide, tall) / 2));
  if (round == 0)
    return Outlines{{{{{x, y}, {x + wide, y}, {x + wide, y + tall}, {x, y + tall}}, true}}, {}, {}};
  const auto corner = fmt::format("a{0} {0} 0 0 1 ", round);
  auto path = svg::read_path(
      fmt::format("M{0} {1}h{2}{4}{5} {5}v{3}{4}-{5} {5}h-{2}{4}-{5} -{5}v-{3}{4}{5} -{5}z",
                  x + round, y, wide - 2 * round, tall - 2 * round, corner, round),
      most_points);
  path.mistake.reset();
  return path;
}

bool CourseReader::is_round(const Element& element) const {
  return element.name == "circle" || element.name == "ellipse";
}

std::vector<Point> CourseReader::placed(const Element& element, const std::vector<Point>& points) {
  std::vector<Point> out;
  for (const auto& point : points) {
    const auto place_cm = element.to_cm(point);
    if (!(std::abs(place_cm.x) <= farthest_cm && std::abs(place_cm.y) <= farthest_cm)) {
      say(rules::CourseTooLarge, place(element.node),
          element.role == Role::Zone ? texts::FarZone() : texts::FarWall(), texts::SetsUnit());
      return {};
    }
    out.push_back(place_cm);
  }
  points_ += out.size();
  if (points_ > most_points && !stop_) {
    stop_ = true;
    say(rules::CourseTooLarge, place(element.node), texts::ManyPoints(most_points),
        texts::Simplify());
  }
  return out;
}

void CourseReader::wall(const Element& element) {
  if (is_round(element))
    return say(rules::CourseCurvedWall, place(element.node),
               element.name == "circle" ? texts::WallIsCircle() : texts::WallIsEllipse(),
               texts::FlattenIt());
  const auto said = out_.findings.size();
  const auto lines = outlines(element);
  if (!lines)
    return refuse(element);
  if (lines->curve && element.name == "path")
    return say(rules::CourseCurvedWall, place(element.node, "d", *lines->curve),
               texts::WallIsCurved(), texts::FlattenIt());
  if (lines->curve)
    return say(rules::CourseCurvedWall, place(element.node, "rx"), texts::CornersRound(),
               texts::RemoveRounding());
  const auto before = pieces_.size();
  for (const auto& line : lines->lines)
    add_pieces(placed(element, line.points), line.closed);
  if (pieces_.size() == before && out_.findings.size() == said)
    say(rules::CourseShape, place(element.node), texts::WallHasNoLength());
}

void CourseReader::add_pieces(const std::vector<Point>& points, bool closed) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 == points.size() && (!closed || points.size() < 3))
      break;
    const auto& to = points[i + 1 == points.size() ? 0 : i + 1];
    if (!(points[i] == to))
      pieces_.push_back({points[i], to});
  }
}

void CourseReader::zone(const Element& element) {
  const auto said = out_.findings.size();
  Zone zone;
  zone.id = element.node.attribute("id").value();
  if (zone.id.empty())
    say(rules::CourseZone, place(element.node), texts::NoId(), texts::GiveId());
  else if (!ids_.insert(zone.id).second)
    say(rules::CourseZone, place(element.node, "id"), texts::DuplicateId(zone.id), texts::OwnId());
  if (is_round(element))
    round_zone(element, zone);
  else if (const auto lines = element.name == "line" ? std::nullopt : outlines(element))
    for (const auto& line : lines->lines)
      zone.rings.push_back(placed(element, line.points));
  else
    return refuse(element);
  std::erase_if(zone.rings, is_flat);
  if (zone.rings.empty()) {
    if (out_.findings.size() == said)
      say(rules::CourseShape, place(element.node), texts::ZoneHasNoArea());
    return;
  }
  zone.fill =
      property(element.node, "fill-rule") == "evenodd" ? Zone::Fill::EvenOdd : Zone::Fill::NonZero;
  out_.course.zones.push_back(std::move(zone));
}

std::optional<Matrix> CourseReader::round_shape(const Element& element) {
  const auto& node = element.node;
  const bool circle = element.name == "circle";
  const double rx = number(node, circle ? "r" : "rx");
  const double ry = number(node, circle ? "r" : "ry");
  if (rx <= 0 || ry <= 0)
    return std::nullopt;
  return element.to_cm * Matrix{rx, 0, 0, ry, number(node, "cx"), number(node, "cy")};
}

void CourseReader::round_zone(const Element& element, Zone& zone) {
  const auto shape = round_shape(element);
  if (!shape || shape->determinant() == 0)
    return;
  const auto& m = *shape;
  const double whole = m.determinant();
  zone.ellipse =
      Zone::Ellipse{{m.e, m.f}, {m.d / whole, -m.c / whole}, {-m.b / whole, m.a / whole}};
  auto in_cm = element;
  in_cm.to_cm = m;
  zone.rings.push_back(placed(in_cm, svg::unit_circle()));
}

void CourseReader::start(const Element& element) {
  Arrow arrow;
  arrow.span = place(element.node);
  if (is_round(element)) {
    const auto& node = element.node;
    const Point middle{number(node, "cx"), number(node, "cy")};
    const double heading = number(node, "data-heading");
    const auto turned = svg::read_transform(fmt::format("rotate({})", heading)).matrix;
    const auto up = turned({0, -1});
    arrow.place = element.to_cm(middle);
    arrow.toward = element.to_cm({middle.x + up.x, middle.y + up.y});
    arrow.circle = true;
  } else {
    const auto lines = outlines(element);
    if (!lines)
      return refuse(element);
    if (lines->lines.size() != 1 || lines->lines.front().closed ||
        lines->lines.front().points.size() < 2)
      return say(rules::CourseStart, arrow.span, texts::ShapeFacesNowhere(), texts::StartIsArrow());
    auto tail = lines->lines.front().points.front();
    auto head = lines->lines.front().points.back();
    const auto has = [&](const char* marker) {
      const auto value = property(element.node, marker);
      return !value.empty() && value != "none";
    };
    if (has("marker-start") && !has("marker-end")) // its head is drawn at its first point
      std::swap(tail, head);
    arrow.place = element.to_cm(tail);
    arrow.toward = element.to_cm(head);
  }
  starts_.push_back(arrow);
}

bool CourseReader::find_start() {
  if (starts_.empty()) {
    say(rules::CourseStart, place(document_.document_element()), texts::NoStart(),
        texts::AddStart("<circle class=\"start\" cx=\"10\" cy=\"10\" r=\"4\"/>"));
    return false;
  }
  auto start = starts_.front();
  if (starts_.size() == 2 && starts_[0].circle != starts_[1].circle) {
    // An arrow that leaves a circle: together they form one start.
    const auto& arrow = starts_[starts_[0].circle ? 1 : 0];
    const auto& circle = starts_[starts_[0].circle ? 0 : 1];
    start.place = circle.place;
    start.toward = Point{circle.place.x + arrow.toward->x - arrow.place.x,
                         circle.place.y + arrow.toward->y - arrow.place.y};
  } else if (starts_.size() > 1) {
    say(rules::CourseStart, starts_[1].span, texts::ManyStarts(starts_.size()), texts::OneStart());
    return false;
  }
  const Point way{start.toward->x - start.place.x, start.toward->y - start.place.y};
  const double length = std::hypot(way.x, way.y);
  if (!(length > 0) || !std::isfinite(length)) {
    say(rules::CourseStart, start.span, texts::StartFacesNowhere(), texts::PointsCoincide());
    return false;
  }
  move_to(start, {way.x / length, way.y / length});
  return true;
}

void CourseReader::move_to(const Arrow& start, Point ahead) {
  const auto moved = [&](Point point) {
    const Point way{point.x - start.place.x, point.y - start.place.y};
    return Point{rounded_cm(way.x * ahead.y - way.y * ahead.x),
                 rounded_cm(way.x * ahead.x + way.y * ahead.y)};
  };
  out_.course.ahead = {rounded_cm(ahead.x), rounded_cm(ahead.y)};
  bool narrow = false;
  for (const auto& piece : pieces_) {
    const auto wall = vm::Wall::between(moved(piece.from), moved(piece.to));
    const auto foot = vm::nearest_point(wall, {});
    narrow = narrow || std::hypot(foot.x, foot.y) < spec::ball::radius;
    out_.course.walls.push_back(wall);
  }
  if (narrow)
    say(rules::CourseNarrow, start.span, texts::WallIsNear(fmt::format("{}", spec::ball::radius)),
        texts::MoveStart());
  for (auto& zone : out_.course.zones) {
    for (auto& ring : zone.rings)
      for (auto& point : ring)
        point = moved(point);
    if (zone.ellipse) {
      const auto turned = [&](Point row) {
        return Point{row.x * ahead.y - row.y * ahead.x, row.x * ahead.x + row.y * ahead.y};
      };
      zone.ellipse->middle = moved(zone.ellipse->middle);
      zone.ellipse->to_x = turned(zone.ellipse->to_x);
      zone.ellipse->to_y = turned(zone.ellipse->to_y);
    }
    zone.box = {zone.rings[0][0], zone.rings[0][0]};
    for (const auto& ring : zone.rings)
      for (const auto& point : ring)
        zone.box.include(point);
  }
}

} // namespace orb::report
