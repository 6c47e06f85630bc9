// From a drawing to a course: the XML, who is a wall, a zone or the start, and where it lies.

#include "base/suggest.h"
#include "base/text.h"
#include "report/course.h"
#include "report/rules.h"
#include "report/svg_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <pugixml.hpp>
#include <set>

namespace orb::report {
namespace {

using svg::Matrix;
using svg::Outline;
using svg::Outlines;
using vm::Point;

// What a course may hold: the explanation of course-too-large says it, too.
constexpr std::size_t most_bytes = 4 << 20;
constexpr int most_groups = 64;
constexpr std::size_t most_elements = 100'000;
constexpr std::size_t most_points = 10'000; ///< of all lines together, and so of walls
constexpr double farthest_cm = 100'000;
constexpr std::size_t most_findings = 50;

enum class Role : std::uint8_t { None, Wall, Zone, Start };

struct RoleName {
  std::string_view word;
  Role role;
};
// The plural is what people call a layer.
constexpr auto role_names = std::to_array<RoleName>({
    {"wall", Role::Wall},
    {"walls", Role::Wall},
    {"zone", Role::Zone},
    {"zones", Role::Zone},
    {"start", Role::Start},
});

std::string_view name_of(Role role) {
  const auto* const found = std::find_if(role_names.begin(), role_names.end(),
                                         [&](const RoleName& row) { return row.role == role; });
  return found->word;
}

/// Elements whose children are not drawn where they stand.
constexpr auto hidden_elements =
    std::to_array<std::string_view>({"defs", "symbol", "clipPath", "mask", "pattern", "marker",
                                     "metadata", "style", "title", "desc"});

struct Unit {
  std::string_view name;
  double cm;
};
constexpr double cm_in_inch = 2.54;
constexpr auto units = std::to_array<Unit>({
    {"mm", 0.1},
    {"cm", 1},
    {"in", cm_in_inch},
    {"px", cm_in_inch / 96}, // Source: CSS: 96 to the inch
    {"pt", cm_in_inch / 72},
    {"pc", cm_in_inch / 6},
});

/// A millionth of a centimetre: what is left of rounding in a transform vanishes.
double rounded(double cm) {
  return std::round(cm * 1e6) / 1e6 + 0.0;
}

std::string_view local_name(std::string_view name) {
  return name.starts_with("svg:") ? name.substr(4) : name;
}

/// A property of CSS in a `style` attribute, or the attribute of its name.
std::string_view property(const pugi::xml_node& node, std::string_view name) {
  std::string_view style = node.attribute("style").value();
  while (!style.empty()) {
    const auto end = std::min(style.find(';'), style.size());
    const auto one = style.substr(0, end);
    const auto colon = one.find(':');
    if (colon != std::string_view::npos && trim(one.substr(0, colon)) == name)
      return trim(one.substr(colon + 1));
    style.remove_prefix(std::min(end + 1, style.size()));
  }
  return node.attribute(std::string(name).c_str()).value();
}

/// An element on its way into the course: from its units to centimetres, y up.
struct Element {
  pugi::xml_node node;
  std::string_view name;
  Matrix to_cm;
  Role role = Role::None;
};

struct Piece {
  Point from;
  Point to;
};
struct Arrow {
  Span span;
  Point place;
  std::optional<Point> toward; ///< of a circle, where it faces; of an arrow, its last point
  bool circle = false;
};

class Reader {
public:
  explicit Reader(const Source& source) : source_(source), text_(source.text()) {}

  CourseReading read() {
    const auto& name = source_.name();
    const auto file = file_name(name);
    out_.course.name = is_course(file) ? stem(file) : file;
    if (is_text() && parse())
      read_drawing();
    sort_by_place(out_.findings);
    return std::move(out_);
  }

private:
  // Findings and their places.
  void say(const Rule& rule, Span span, std::string message, std::string help = {}) {
    if (out_.findings.size() < most_findings)
      out_.findings.push_back(finding(rule, span, std::move(message), std::move(help)));
  }
  bool failed() const { return any_error(out_.findings); }
  /// `<name` in the text.
  Span place(const pugi::xml_node& node) const {
    const auto offset = node.offset_debug();
    if (offset < 1)
      return {};
    const auto begin = static_cast<std::uint32_t>(offset) - 1;
    const auto length = std::string_view(node.name()).size() + 1;
    return {begin, std::min(begin + static_cast<std::uint32_t>(length), size())};
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(text_.size()); }
  /// The value of an attribute in the text; the element where it has none.
  Span place(const pugi::xml_node& node, std::string_view attribute) const {
    const auto element = place(node);
    std::size_t at = element.end;
    while (at < text_.size() && text_[at] != '>' && text_[at] != '/') {
      const auto begin = text_.find_first_not_of(" \t\r\n", at);
      const auto equals = text_.find('=', at);
      if (equals == std::string_view::npos)
        break;
      const auto quote = text_.find_first_of("\"'", equals);
      const auto end =
          quote == std::string_view::npos ? quote : text_.find(text_[quote], quote + 1);
      if (end == std::string_view::npos)
        break;
      auto name = text_.substr(begin, equals - begin);
      while (!name.empty() && (is_blank(name.back()) || name.back() == '\n' || name.back() == '\r'))
        name.remove_suffix(1);
      if (name == attribute)
        return {static_cast<std::uint32_t>(quote) + 1, static_cast<std::uint32_t>(end)};
      at = std::min(text_.find_first_not_of(" \t\r\n", end + 1), text_.size());
    }
    return element;
  }
  Span place(const pugi::xml_node& node, std::string_view attribute, Span within) const {
    const auto value = place(node, attribute);
    return {std::min(value.begin + within.begin, value.end),
            std::min(value.begin + within.end, value.end)};
  }

  // XML.
  bool is_text() {
    if (text_.size() > most_bytes) {
      say(rules::CourseTooLarge, {0, 0}, fmt::format("the file has {} bytes", text_.size()),
          "4 MB is the most; delete what is neither wall, nor zone, nor start");
      return false;
    }
    if (text_.starts_with("\x1f\x8b")) {
      say(rules::CourseXml, {0, 0}, "the drawing is compressed",
          "save it as Plain SVG, not as Compressed SVG");
      return false;
    }
    const auto odd = std::find_if(text_.begin(), text_.end(), [](char c) {
      return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
    });
    if (odd != text_.end()) {
      const auto at = static_cast<std::uint32_t>(odd - text_.begin());
      say(rules::CourseXml, {at, at + 1}, "the file is not text",
          "a course is a drawing in SVG; save it as Plain SVG");
      return false;
    }
    if (const auto at = text_.find("<!ENTITY"); at != std::string_view::npos) {
      const auto begin = static_cast<std::uint32_t>(at);
      say(rules::CourseXml, {begin, begin + 8}, "the file declares entities, which are not read",
          "save it as Plain SVG");
      return false;
    }
    return true;
  }
  bool parse() {
    const auto result =
        document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
      const auto at =
          std::min(static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(result.offset, 0)), size());
      const bool tags = result.status == pugi::status_end_element_mismatch;
      std::string why = result.description();
      why.front() = to_lower(why.front());
      say(rules::CourseXml, {at, std::min(at + 1, size())},
          tags ? "this end tag closes no open element"
               : fmt::format("the file is not well-formed XML: {}", why),
          tags ? "each `<g>` needs a `</g>`; an element without children ends in `/>`" : "");
      return false;
    }
    const auto root = document_.document_element();
    if (local_name(root.name()) != "svg") {
      say(rules::CourseXml, place(root),
          fmt::format("the outermost element is `<{}>`, not `<svg>`", root.name()),
          "a course is a drawing in SVG");
      return false;
    }
    return true;
  }

  // The drawing.
  void read_drawing() {
    const auto root = document_.document_element();
    const double cm = scale(root);
    Matrix to_cm;
    to_cm.a = cm;
    to_cm.d = -cm;
    walk({root, "svg", to_cm, Role::None}, 0);
    if (failed() || !find_start())
      return;
    if (out_.course.walls.empty() && out_.course.zones.empty())
      say(rules::CourseEmpty, place(root), "no element is a `wall` or a `zone`",
          "give the lines that stop the ball `class=\"wall\"`");
  }

  /// How many centimetres 1 is.
  double scale(const pugi::xml_node& root) {
    const auto box = attribute_numbers(root, "viewBox");
    if (box.empty())
      return 1;
    if (box.size() != 4 || box[2] <= 0 || box[3] <= 0) {
      say(rules::CourseValue, place(root, "viewBox"),
          "`viewBox` is four numbers: left, top, width and height",
          "as in `viewBox=\"0 0 210 297\"`");
      return 1;
    }
    const auto wide = size_cm(root, "width");
    const auto tall = size_cm(root, "height");
    if (!wide && !tall)
      return 1;
    const double by_width = wide.value_or(0) / box[2];
    const double by_height = tall.value_or(0) / box[3];
    if (!wide || !tall)
      return wide ? by_width : by_height;
    constexpr double alike = 0.01;
    if (std::abs(by_width - by_height) > alike * by_width)
      say(rules::CourseScale, place(root, "viewBox"),
          fmt::format("1 unit is {:.4g} cm by the width and {:.4g} cm by the height", by_width,
                      by_height),
          fmt::format("the smaller one counts; `height=\"{:.6g}cm\"` would fit",
                      by_width * box[3]));
    return std::min(by_width, by_height);
  }
  /// `210mm` in centimetres; nothing where it has no unit of length.
  std::optional<double> size_cm(const pugi::xml_node& root, const char* attribute) {
    const std::string_view text = trim(root.attribute(attribute).value());
    const auto digits = std::min(text.find_first_not_of("0123456789."), text.size());
    const auto unit = trim(text.substr(digits));
    const auto value = parse_number<double>(text.substr(0, digits), std::chars_format::fixed);
    const bool plain = text.empty() || ((unit.empty() || unit == "%") && value);
    const auto* const found =
        std::find_if(units.begin(), units.end(), [&](const Unit& row) { return row.name == unit; });
    if (plain)
      return std::nullopt;
    if (!value || *value <= 0 || found == units.end()) {
      say(rules::CourseValue, place(root, attribute), fmt::format("`{}` is not a size", text),
          "write it like 21cm, 210mm, 8.27in or 794px");
      return std::nullopt;
    }
    return *value * found->cm;
  }

  void walk(const Element& parent, int depth) {
    if (depth > most_groups) {
      say(rules::CourseTooLarge, place(parent.node),
          fmt::format("more than {} groups lie inside each other", most_groups),
          "in Inkscape ungroup what is not one thing (Shift+Ctrl+G)");
      return;
    }
    for (const auto& node : parent.node.children()) {
      if (node.type() != pugi::node_element || stop_)
        continue;
      if (++elements_ > most_elements) {
        say(rules::CourseTooLarge, place(node),
            fmt::format("the drawing has more than {} elements", most_elements),
            "delete what is neither wall, nor zone, nor start");
        stop_ = true;
        return;
      }
      enter(parent, node, depth);
    }
  }

  void enter(const Element& parent, const pugi::xml_node& node, int depth) {
    const auto name = local_name(node.name());
    if (std::find(hidden_elements.begin(), hidden_elements.end(), name) != hidden_elements.end() ||
        name.find(':') != std::string_view::npos || property(node, "display") == "none")
      return;
    const auto own = role_of(node);
    const Element element{node, name, parent.to_cm * transform(node),
                          own == Role::None ? parent.role : own};
    if (name == "g" || name == "a" || name == "switch")
      return walk(element, depth + 1);
    if (own == Role::None && (name == "text" || name == "image"))
      return; // words and pictures on a layer of walls
    switch (element.role) {
    case Role::None:
      if (name == "svg")
        walk(element, depth + 1);
      return;
    case Role::Wall: return wall(element);
    case Role::Zone: return zone(element);
    case Role::Start: return start(element);
    }
  }

  /// What its class, or the label that Inkscape gives it, says an element is.
  Role role_of(const pugi::xml_node& node) {
    for (const auto* attribute : {"class", "inkscape:label", "label"}) {
      std::string_view words = node.attribute(attribute).value();
      while (!(words = trim(words)).empty()) {
        const auto word = words.substr(0, words.find_first_of(" \t\n"));
        words.remove_prefix(word.size());
        const auto* const found =
            std::find_if(role_names.begin(), role_names.end(),
                         [&](const RoleName& row) { return equal_words(row.word, word); });
        if (found != role_names.end())
          return found->role;
        doubt(node, attribute, word);
      }
    }
    return Role::None;
  }
  /// A word with a letter too many, too few or in the wrong place is a slip. Another letter is
  /// another word: `hall`, `ball`.
  void doubt(const pugi::xml_node& node, std::string_view attribute, std::string_view word) {
    std::vector<std::string_view> names;
    for (const auto& row : role_names)
      names.push_back(row.word);
    const auto meant = closest(word, names);
    if (meant && (meant->size() != word.size() ||
                  std::is_permutation(word.begin(), word.end(), meant->begin())))
      say(rules::CourseName, place(node, attribute), fmt::format("`{}` is decoration", word),
          fmt::format("did you mean `{}`?", *meant));
  }

  // Attributes.
  Matrix transform(const pugi::xml_node& node) {
    if (!property(node, "transform").empty() && node.attribute("transform").empty())
      say(rules::CourseValue, place(node, "style"), "a `transform` in `style` is not read",
          "write it as an attribute: transform=\"…\"");
    const auto read = svg::read_transform(node.attribute("transform").value());
    tell(node, "transform", read.mistake);
    return read.matrix;
  }
  void tell(const pugi::xml_node& node, std::string_view attribute,
            const std::optional<svg::Mistake>& mistake) {
    if (mistake)
      say(rules::CourseValue, place(node, attribute, mistake->span),
          fmt::format("`{}`: {}", attribute, mistake->message), mistake->help);
  }
  std::vector<double> attribute_numbers(const pugi::xml_node& node, const char* attribute) {
    const auto read = svg::read_numbers(node.attribute(attribute).value());
    tell(node, attribute, read.mistake);
    return read.values;
  }
  double number(const pugi::xml_node& node, const char* attribute) {
    auto text = trim(node.attribute(attribute).value());
    if (text.ends_with("px"))
      text.remove_suffix(2);
    if (text.empty())
      return 0;
    const auto value = parse_number<double>(text.front() == '+' ? text.substr(1) : text);
    if (!value || !std::isfinite(*value)) {
      say(rules::CourseValue, place(node, attribute),
          fmt::format("`{}` is a number without a unit, found `{}`", attribute, text),
          "`width`, `height` and `viewBox` of the drawing say how long 1 is");
      return 0;
    }
    return *value;
  }

  // Shapes.
  /// The lines of an element in its own units; nothing, with a finding, where it has none.
  std::optional<Outlines> outlines(const Element& element) {
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
  std::optional<Outlines> points(const Element& element) {
    const auto numbers = attribute_numbers(element.node, "points");
    if (numbers.size() % 2 != 0)
      say(rules::CourseValue, place(element.node, "points"),
          fmt::format("`points` has {} numbers; a point is two", numbers.size()));
    Outline line;
    for (std::size_t i = 0; i + 1 < numbers.size() && i < 2 * most_points; i += 2)
      line.points.push_back({numbers[i], numbers[i + 1]});
    line.closed = element.name == "polygon";
    return Outlines{{std::move(line)}, {}, {}};
  }
  std::optional<Outlines> rectangle(const Element& element) {
    const auto& node = element.node;
    const double x = number(node, "x");
    const double y = number(node, "y");
    const double wide = number(node, "width");
    const double tall = number(node, "height");
    const double given = std::max(number(node, "rx"), number(node, "ry"));
    const double round = std::clamp(given, 0.0, std::max(0.0, std::min(wide, tall) / 2));
    if (round == 0)
      return Outlines{
          {{{{x, y}, {x + wide, y}, {x + wide, y + tall}, {x, y + tall}}, true}}, {}, {}};
    const auto corner = fmt::format("a{0} {0} 0 0 1 ", round);
    auto path = svg::read_path(
        fmt::format("M{0} {1}h{2}{4}{5} {5}v{3}{4}-{5} {5}h-{2}{4}-{5} -{5}v-{3}{4}{5} -{5}z",
                    x + round, y, wide - 2 * round, tall - 2 * round, corner, round),
        most_points);
    path.mistake.reset();
    return path;
  }
  bool is_round(const Element& element) const {
    return element.name == "circle" || element.name == "ellipse";
  }
  void refuse(const Element& element) {
    const bool clone = element.name == "use";
    say(rules::CourseShape, place(element.node),
        clone ? "a clone is not read"
              : fmt::format("`{}` cannot be a {}", element.name, name_of(element.role)),
        clone                         ? "in Inkscape: Edit > Clone > Unlink Clone (Shift+Alt+D)"
        : element.role == Role::Start ? "a start is a circle, or an arrow: a line or an open path"
        : element.role == Role::Zone
            ? "a zone is a rect, a polygon, a closed path, a circle or an ellipse"
            : "a wall is a line, a polyline, a polygon, a rect or a path");
  }
  /// Into centimetres; with a finding where that is too far or too much.
  std::vector<Point> placed(const Element& element, const std::vector<Point>& points) {
    std::vector<Point> out;
    for (const auto& point : points) {
      const auto place_cm = element.to_cm(point);
      if (!(std::abs(place_cm.x) <= farthest_cm && std::abs(place_cm.y) <= farthest_cm)) {
        say(rules::CourseTooLarge, place(element.node),
            fmt::format("this {} reaches farther than 1 km", name_of(element.role)),
            "`width`, `height` and `viewBox` of the drawing say how long 1 is");
        return {};
      }
      out.push_back(place_cm);
    }
    points_ += out.size();
    if (points_ > most_points && !stop_) {
      stop_ = true;
      say(rules::CourseTooLarge, place(element.node),
          fmt::format("walls and zones have more than {} points", most_points),
          "in Inkscape: Path > Simplify, or draw them with fewer points");
    }
    return out;
  }

  void wall(const Element& element) {
    constexpr std::string_view help = "draw it with straight pieces, or make them of it: "
                                      "Extensions > Modify Path > Flatten Bezier";
    if (is_round(element))
      return say(rules::CourseCurvedWall, place(element.node),
                 fmt::format("a wall cannot be a {}", element.name), std::string(help));
    const auto said = out_.findings.size();
    const auto lines = outlines(element);
    if (!lines)
      return refuse(element);
    if (lines->curve)
      return say(rules::CourseCurvedWall,
                 element.name == "path" ? place(element.node, "d", *lines->curve)
                                        : place(element.node, "rx"),
                 element.name == "path" ? "this part of the wall is curved"
                                        : "the corners of this wall are round",
                 std::string(element.name == "path" ? help : "take `rx` and `ry` away"));
    const auto before = pieces_.size();
    for (const auto& line : lines->lines)
      add_pieces(placed(element, line.points), line.closed);
    if (pieces_.size() == before && out_.findings.size() == said)
      say(rules::CourseShape, place(element.node), "this wall has no length");
  }
  void add_pieces(const std::vector<Point>& points, bool closed) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i + 1 == points.size() && (!closed || points.size() < 3))
        break;
      const auto& to = points[i + 1 == points.size() ? 0 : i + 1];
      if (!(points[i] == to))
        pieces_.push_back({points[i], to});
    }
  }

  void zone(const Element& element) {
    const auto said = out_.findings.size();
    Zone zone;
    zone.id = element.node.attribute("id").value();
    if (zone.id.empty())
      say(rules::CourseZone, place(element.node), "this zone has no `id`",
          "give it one, such as `id=\"goal\"`: tests call it by that");
    else if (!ids_.insert(zone.id).second)
      say(rules::CourseZone, place(element.node, "id"),
          fmt::format("another zone is called `{}`, too", zone.id),
          "each zone has an id of its own");
    if (is_round(element))
      round_zone(element, zone);
    else if (const auto lines = element.name == "line" ? std::nullopt : outlines(element))
      for (const auto& line : lines->lines)
        zone.rings.push_back(placed(element, line.points));
    else
      return refuse(element);
    std::erase_if(zone.rings, [](const auto& ring) { return ring.size() < 3; });
    if (zone.rings.empty()) {
      if (out_.findings.size() == said)
        say(rules::CourseShape, place(element.node), "this zone has no inside");
      return;
    }
    zone.fill = property(element.node, "fill-rule") == "evenodd" ? Zone::Fill::EvenOdd
                                                                 : Zone::Fill::NonZero;
    out_.course.zones.push_back(std::move(zone));
  }
  /// The middle of a circle or ellipse and its two radii.
  std::optional<Matrix> round_shape(const Element& element) {
    const auto& node = element.node;
    const bool circle = element.name == "circle";
    const double rx = number(node, circle ? "r" : "rx");
    const double ry = number(node, circle ? "r" : "ry");
    if (rx <= 0 || ry <= 0)
      return std::nullopt;
    return element.to_cm * Matrix{rx, 0, 0, ry, number(node, "cx"), number(node, "cy")};
  }
  void round_zone(const Element& element, Zone& zone) {
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

  // The start.
  void start(const Element& element) {
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
        return say(rules::CourseStart, arrow.span, "this shape does not say where the ball faces",
                   "a start is a circle, or an arrow: one line or open path from its tail to its "
                   "head");
      auto tail = lines->lines.front().points.front();
      auto head = lines->lines.front().points.back();
      const auto has = [&](const char* marker) {
        const auto value = property(element.node, marker);
        return !value.empty() && value != "none";
      };
      if (has("marker-start") && !has("marker-end")) // its head was drawn at its first point
        std::swap(tail, head);
      arrow.place = element.to_cm(tail);
      arrow.toward = element.to_cm(head);
    }
    starts_.push_back(arrow);
  }

  /// Moves and turns everything so that the start is 0,0 facing +Y. False where there is none.
  bool find_start() {
    if (starts_.empty()) {
      say(rules::CourseStart, place(document_.document_element()), "the course has no start",
          "add one: `<circle class=\"start\" cx=\"10\" cy=\"10\" r=\"4\"/>`");
      return false;
    }
    auto start = starts_.front();
    if (starts_.size() == 2 && starts_[0].circle != starts_[1].circle) {
      // An arrow that leaves a circle: together they are one start.
      const auto& arrow = starts_[starts_[0].circle ? 1 : 0];
      const auto& circle = starts_[starts_[0].circle ? 0 : 1];
      start.place = circle.place;
      start.toward = Point{circle.place.x + arrow.toward->x - arrow.place.x,
                           circle.place.y + arrow.toward->y - arrow.place.y};
    } else if (starts_.size() > 1) {
      say(rules::CourseStart, starts_[1].span,
          fmt::format("the course has {} starts", starts_.size()), "a ball starts in one place");
      return false;
    }
    const Point way{start.toward->x - start.place.x, start.toward->y - start.place.y};
    const double length = std::hypot(way.x, way.y);
    if (!(length > 0) || !std::isfinite(length)) {
      say(rules::CourseStart, start.span, "this start does not say where the ball faces",
          "its first and its last point are in the same place");
      return false;
    }
    move_to(start, {way.x / length, way.y / length});
    return true;
  }
  void move_to(const Arrow& start, Point ahead) {
    const auto moved = [&](Point point) {
      const Point way{point.x - start.place.x, point.y - start.place.y};
      return Point{rounded(way.x * ahead.y - way.y * ahead.x),
                   rounded(way.x * ahead.x + way.y * ahead.y)};
    };
    out_.course.ahead = {rounded(ahead.x), rounded(ahead.y)};
    bool narrow = false;
    for (const auto& piece : pieces_) {
      const auto wall = vm::Wall::between(moved(piece.from), moved(piece.to));
      const auto foot = vm::nearest_point(wall, {});
      narrow = narrow || std::hypot(foot.x, foot.y) < spec::ball::radius;
      out_.course.walls.push_back(wall);
    }
    if (narrow)
      say(rules::CourseNarrow, start.span,
          fmt::format("a wall is nearer to the start than {} cm, the radius of the ball",
                      spec::ball::radius),
          "move the start or the wall");
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

  const Source& source_;
  std::string_view text_;
  pugi::xml_document document_;
  CourseReading out_;
  std::vector<Piece> pieces_; ///< of walls, before they are moved to the start
  std::vector<Arrow> starts_;
  std::set<std::string> ids_;
  std::size_t elements_ = 0;
  std::size_t points_ = 0;
  bool stop_ = false;
};

} // namespace

CourseReading read_course(const Source& drawing) {
  return Reader(drawing).read();
}

} // namespace orb::report
