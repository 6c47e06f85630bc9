#pragma once

#include "base/message.h"
#include "base/source.h"
#include "vm/body/body.h"

#include <optional>
#include <string_view>
#include <vector>

// The small languages inside the attributes of an SVG: lists of numbers, transforms, path data.
// Places are in the units of the drawing, y down.

namespace orb::report::svg {

using vm::Point;

/// x' = a x + c y + e, y' = b x + d y + f: the order of SVG's matrix().
struct Matrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  Point operator()(Point point) const {
    return {a * point.x + c * point.y + e, b * point.x + d * point.y + f};
  }
  /// First `inner`, then this one.
  Matrix operator*(const Matrix& inner) const;
  double determinant() const { return a * d - b * c; }
};

/// What is wrong in an attribute: the bytes of it, what was seen and what helps.
struct Mistake {
  Span span;
  Message message;
  Message help;
};

/// A line through points; a ring where it is closed.
struct Outline {
  std::vector<Point> points;
  bool closed = false;
};

/// Lines, and the first curve among them, which is in them as short straight pieces.
struct Outlines {
  std::vector<Outline> lines;
  std::optional<Span> curve;
  std::optional<Mistake> mistake; ///< what stands before it is good
};

/// Numbers with blanks or commas between them, as in `viewBox`.
struct Numbers {
  std::vector<double> values;
  std::optional<Mistake> mistake;
};
Numbers read_numbers(std::string_view text);

struct Transform {
  Matrix matrix;
  std::optional<Mistake> mistake;
};
/// The value of a `transform` attribute.
Transform read_transform(std::string_view text);

/// The value of a `d` attribute; at most `most_points` points.
Outlines read_path(std::string_view text, std::size_t most_points);

/// A closed ring around 0,0 through places on the circle of radius 1.
std::vector<Point> unit_circle();

} // namespace orb::report::svg
