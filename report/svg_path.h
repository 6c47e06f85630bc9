#pragma once

#include "base/message.h"
#include "base/source.h"
#include "vm/body/body.h"

#include <optional>
#include <string_view>
#include <vector>

// The notations inside SVG attributes: lists of numbers, transforms, path data. Places are in the
// units of the drawing, y down.

namespace orb::report::svg {

using vm::Point;

/// x' = a x + c y + e, y' = b x + d y + f, with the parameters in the order of SVG's matrix().
struct Matrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  Point operator()(Point point) const {
    return {a * point.x + c * point.y + e, b * point.x + d * point.y + f};
  }
  /// Applies `inner` first, then this one.
  Matrix operator*(const Matrix& inner) const;
  double determinant() const { return a * d - b * c; }
};

/// A mistake in an attribute: its bytes, what is wrong and what helps.
struct Mistake {
  Span span;
  Message message;
  Message help;
};

/// A polyline; a ring if closed.
struct Outline {
  std::vector<Point> points;
  bool closed = false;
};

/// Polylines. Curves are approximated by short segments; `curve` is the first of them.
struct Outlines {
  std::vector<Outline> lines;
  std::optional<Span> curve;
  std::optional<Mistake> mistake; ///< everything before it is valid
};

/// Numbers separated by blanks or commas, as in `viewBox`.
struct Numbers {
  std::vector<double> values;
  std::optional<Mistake> mistake;
};
Numbers read_numbers(std::string_view text);

struct Transform {
  Matrix matrix;
  std::optional<Mistake> mistake;
};
/// Parses a `transform` attribute.
Transform read_transform(std::string_view text);

/// Parses a `d` attribute, up to `most_points` points.
Outlines read_path(std::string_view text, std::size_t most_points);

/// Returns a ring of points on the unit circle.
std::vector<Point> unit_circle();

} // namespace orb::report::svg
