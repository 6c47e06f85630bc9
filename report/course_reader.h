#pragma once

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "report/course.h"
#include "report/rules.h"
#include "report/svg_path.h"
#include "report/texts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <pugixml.hpp>
#include <set>

namespace orb::report {

using svg::Matrix;
using svg::Outline;
using svg::Outlines;
using vm::Point;

enum class Role : std::uint8_t { None, Wall, Zone, Start };

/// Returns a CSS property from the `style` attribute, otherwise the attribute of that name.
inline std::string_view property(const pugi::xml_node& node, std::string_view name) {
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

/// An element and its transform to centimetres, y up.
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
  std::optional<Point> toward; ///< direction of a circle, or end point of an arrow
  bool circle = false;
};

/// Reads walls, zones and the start from a drawing. Large because each kind of element and
/// attribute has its own reader.
class CourseReader {
public:
  explicit CourseReader(const Source& source) : source_(source), text_(source.text()) {}

  CourseReading read();

private:
  // Findings and their places.
  void say(const Rule& rule, Span span, Message message, Message help = {});
  bool failed() const { return any_error(out_.findings); }
  /// The span of `<name` in the text.
  Span place(const pugi::xml_node& node) const;
  std::uint32_t size() const { return static_cast<std::uint32_t>(text_.size()); }
  /// The span of an attribute's value in the text, or of the element if it has none.
  Span place(const pugi::xml_node& node, std::string_view attribute) const;
  Span place(const pugi::xml_node& node, std::string_view attribute, Span within) const;

  // XML.
  bool is_text();
  bool parse();

  // The drawing.
  void read_drawing();

  /// Centimetres per unit.
  double scale(const pugi::xml_node& root);
  /// Converts `210mm` to centimetres; nullopt without a unit of length.
  std::optional<double> size_cm(const pugi::xml_node& root, const char* attribute);

  void walk(const Element& parent, int depth);

  void enter(const Element& parent, const pugi::xml_node& node, int depth);

  /// Returns the role given by the class, or by Inkscape's label.
  Role role_of(const pugi::xml_node& node);
  /// Reports a probable slip: a letter too many, too few or out of place. A different letter makes
  /// a different word: `hall`, `ball`.
  void doubt(const pugi::xml_node& node, std::string_view attribute, std::string_view word);

  // Attributes.
  Matrix transform(const pugi::xml_node& node);
  void tell(const pugi::xml_node& node, std::string_view attribute,
            const std::optional<svg::Mistake>& mistake);
  std::vector<double> attribute_numbers(const pugi::xml_node& node, const char* attribute);
  double number(const pugi::xml_node& node, const char* attribute);

  // Shapes.
  /// Returns the lines of an element in its own units; nullopt, with a finding, if it has none.
  std::optional<Outlines> outlines(const Element& element);
  std::optional<Outlines> points(const Element& element);
  std::optional<Outlines> rectangle(const Element& element);
  bool is_round(const Element& element) const;
  void refuse(const Element& element);
  /// Converts points to centimetres. Adds a finding if they are too far away or too many.
  std::vector<Point> placed(const Element& element, const std::vector<Point>& points);

  void wall(const Element& element);
  void add_pieces(const std::vector<Point>& points, bool closed);

  void zone(const Element& element);
  /// Returns the map from the unit circle: middle and two radii.
  std::optional<Matrix> round_shape(const Element& element);
  void round_zone(const Element& element, Zone& zone);

  // The start.
  void start(const Element& element);

  /// Moves and turns everything so that the start is 0,0 facing +Y. Returns false if there is no
  /// start.
  bool find_start();
  void move_to(const Arrow& start, Point ahead);

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

} // namespace orb::report
