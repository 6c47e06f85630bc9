#include "report/svg_path.h"

#include "base/text/text.h"
#include "report/texts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orb::report::svg {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double to_radians = pi / 180; // 180 degrees are pi
constexpr int curve_pieces = 24;
constexpr int circle_pieces = 72;

bool is_gap(char c) {
  return is_blank(c) || c == '\n' || c == '\r' || c == '\f';
}

/// Scans the text of an attribute.
class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool done() const { return at_ == text_.size(); }
  char peek() const { return done() ? '\0' : text_[at_]; }
  void skip() { ++at_; }
  std::uint32_t at() const { return static_cast<std::uint32_t>(at_); }

  void gaps() {
    while (!done() && is_gap(text_[at_]))
      ++at_;
  }
  /// Skips blanks and at most one comma.
  void separator() {
    gaps();
    if (peek() == ',')
      ++at_;
    gaps();
  }
  bool take(char c) {
    if (peek() != c || done())
      return false;
    ++at_;
    return true;
  }
  std::string_view letters() {
    const auto begin = at_;
    while (!done() && is_letter(text_[at_]))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  bool at_number() const {
    const char c = peek();
    return is_digit(c) || c == '.' || c == '-' || c == '+';
  }
  /// Parses an SVG number: a point or a sign may begin the next one.
  std::optional<double> number() {
    const auto begin = at_;
    auto end = at_;
    const auto digits = [&] {
      const auto first = end;
      while (end < text_.size() && is_digit(text_[end]))
        ++end;
      return end - first;
    };
    const auto is_at = [&](std::string_view one_of) {
      return end < text_.size() && one_of.find(text_[end]) != std::string_view::npos;
    };
    if (is_at("+-"))
      ++end;
    auto count = digits();
    if (is_at(".")) {
      ++end;
      count += digits();
    }
    if (count == 0)
      return std::nullopt;
    if (is_at("eE")) {
      const auto mantissa = end++;
      if (is_at("+-"))
        ++end;
      if (digits() == 0)
        end = mantissa;
    }
    auto text = text_.substr(begin, end - begin);
    if (text.front() == '+')
      text.remove_prefix(1);
    const auto value = parse_number<double>(text);
    if (value)
      at_ = end;
    return value;
  }
  /// Parses 0 or 1. The next number may follow without a blank.
  std::optional<bool> flag() {
    if (peek() != '0' && peek() != '1')
      return std::nullopt;
    return text_[at_++] == '1';
  }
  /// Quotes the text from here to the next blank in a mistake.
  Mistake mistake(Message wanted, Message help) const {
    auto end = at_;
    while (end < text_.size() && !is_gap(text_[end]) && text_[end] != ',' && end - at_ < 20)
      ++end;
    while (end < text_.size() && is_utf8_tail(text_[end]))
      ++end;
    end = std::max(end, std::min(at_ + 1, text_.size()));
    const auto seen = text_.substr(at_, end - at_);
    return {{at(), static_cast<std::uint32_t>(end)},
            seen.empty() ? texts::MissingAtEnd(std::move(wanted))
                         : texts::Found(texts::Expected(std::move(wanted)), seen),
            std::move(help)};
  }

private:
  std::string_view text_;
  std::size_t at_ = 0;
};

struct Function {
  std::string_view name;
  std::size_t least;
  std::size_t most;
  Matrix (*matrix)(const std::array<double, 6>& values, std::size_t count);
};

Matrix turn(double degrees) {
  // Quarter turns are exact.
  const double quarters = degrees / 90; // quarter turns
  if (quarters == std::floor(quarters) && std::abs(quarters) < 1e6) {
    constexpr std::array<double, 4> sines{0, 1, 0, -1};
    const auto quarter = static_cast<std::size_t>((static_cast<long>(quarters) % 4 + 4) % 4);
    const double sine = sines[quarter];
    const double cosine = sines[(quarter + 1) % 4];
    return {cosine, sine, -sine, cosine, 0, 0};
  }
  const double sine = std::sin(degrees * to_radians);
  const double cosine = std::cos(degrees * to_radians);
  return {cosine, sine, -sine, cosine, 0, 0};
}

Matrix move(double x, double y) {
  return {1, 0, 0, 1, x, y};
}

// clang-format off
constexpr auto functions = std::to_array<Function>({
    {"translate", 1, 2, [](const auto& v, std::size_t) { return move(v[0], v[1]); }},
    {"scale",     1, 2, [](const auto& v, std::size_t n) { return Matrix{v[0], 0, 0, n == 1 ? v[0] : v[1], 0, 0}; }},
    {"rotate",    1, 3, [](const auto& v, std::size_t) { return move(v[1], v[2]) * turn(v[0]) * move(-v[1], -v[2]); }},
    {"matrix",    6, 6, [](const auto& v, std::size_t) { return Matrix{v[0], v[1], v[2], v[3], v[4], v[5]}; }},
    {"skewX",     1, 1, [](const auto& v, std::size_t) { return Matrix{1, 0, std::tan(v[0] * to_radians), 1, 0, 0}; }},
    {"skewY",     1, 1, [](const auto& v, std::size_t) { return Matrix{1, std::tan(v[0] * to_radians), 0, 1, 0, 0}; }},
});
// clang-format on

/// Converts path data to lines: executes SVG's commands and tracks the pen.
class Path {
public:
  Path(std::string_view text, std::size_t most_points) : scan_(text), most_points_(most_points) {}

  Outlines read() {
    scan_.gaps();
    while (!scan_.done() && !out_.mistake) {
      const char command = scan_.peek();
      if (!is_letter(command)) {
        fail(texts::ACommand());
      } else if (first_ && to_lower(command) != 'm') {
        fail(Message::as_is("M"));
      } else if (std::string_view("MLHVZCSQTA").find(to_upper(command)) == std::string_view::npos) {
        fail(texts::OneCommandOf());
      } else {
        begin_ = scan_.at();
        scan_.skip();
        repeat(command);
      }
      scan_.gaps();
    }
    return std::move(out_);
  }

private:
  /// Executes a command; further coordinates repeat it without its letter.
  void repeat(char command) {
    first_ = false;
    relative_ = command >= 'a';
    auto kind = to_upper(command);
    if (kind == 'Z')
      return close();
    do {
      scan_.separator();
      segment(kind);
      last_ = kind;
      if (kind == 'M')
        kind = 'L';
      const auto before = scan_;
      scan_.separator();
      if (!scan_.at_number()) {
        scan_ = before;
        return;
      }
    } while (!out_.mistake);
  }

  void segment(char kind) {
    switch (kind) {
    case 'M': return start_line(point());
    case 'L': return line_to(point());
    case 'H': return line_to({coordinate(relative_ ? pen_.x : 0), pen_.y});
    case 'V': return line_to({pen_.x, coordinate(relative_ ? pen_.y : 0)});
    case 'C': {
      const auto first = point();
      return cubic(first, point());
    }
    case 'S': return cubic(last_ == 'C' || last_ == 'S' ? mirrored() : pen_, point());
    case 'Q': return quadratic(point());
    case 'T': return quadratic(last_ == 'Q' || last_ == 'T' ? mirrored() : pen_);
    case 'A': return arc();
    default: return;
    }
  }

  double coordinate(double from) {
    if (out_.mistake)
      return 0;
    const auto value = scan_.number();
    if (!value)
      fail(texts::ANumber());
    return from + value.value_or(0);
  }
  Point point() {
    const double x = coordinate(relative_ ? pen_.x : 0);
    scan_.separator();
    const double y = coordinate(relative_ ? pen_.y : 0);
    scan_.separator();
    return {x, y};
  }
  Point mirrored() const { return {2 * pen_.x - control_.x, 2 * pen_.y - control_.y}; }

  void start_line(Point to) {
    if (out_.mistake)
      return;
    out_.lines.push_back({{to}, false});
    pen_ = to;
    ++points_;
  }
  void line_to(Point to) {
    if (out_.mistake)
      return;
    if (out_.lines.back().closed) // after Z the next line begins where the last one began
      start_line(out_.lines.back().points.front());
    if (++points_ > most_points_)
      return fail(texts::EndAfter(most_points_), texts::Simplify());
    out_.lines.back().points.push_back(to);
    pen_ = to;
  }
  void close() {
    out_.lines.back().closed = true;
    pen_ = out_.lines.back().points.front();
    last_ = 'Z';
  }

  /// Returns true if a point lies on the segment from the pen to `to`.
  bool on_the_way(Point point, Point to) const {
    return std::hypot(point.x - pen_.x, point.y - pen_.y) +
               std::hypot(to.x - point.x, to.y - point.y) <=
           std::hypot(to.x - pen_.x, to.y - pen_.y) * (1 + 1e-9) + 1e-9;
  }
  void mark_curve() {
    if (!out_.curve)
      out_.curve = Span{begin_, scan_.at()};
  }
  template <class At>
  void pieces(Point to, At at) {
    for (int i = 1; i < curve_pieces; ++i)
      line_to(at(double{1} * i / curve_pieces));
    line_to(to);
  }

  void cubic(Point first, Point second) {
    const auto to = point();
    if (out_.mistake)
      return;
    const auto from = pen_;
    if (on_the_way(first, to) && on_the_way(second, to)) {
      line_to(to);
    } else {
      mark_curve();
      pieces(to, [&](double t) {
        const double s = 1 - t;
        const auto mix = [&](double a, double b, double c, double d) {
          return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
        };
        return Point{mix(from.x, first.x, second.x, to.x), mix(from.y, first.y, second.y, to.y)};
      });
    }
    control_ = second;
  }
  void quadratic(Point middle) {
    const auto to = point();
    if (out_.mistake)
      return;
    const auto from = pen_;
    if (on_the_way(middle, to)) {
      line_to(to);
    } else {
      mark_curve();
      pieces(to, [&](double t) {
        const double s = 1 - t;
        return Point{s * s * from.x + 2 * s * t * middle.x + t * t * to.x,
                     s * s * from.y + 2 * s * t * middle.y + t * t * to.y};
      });
    }
    control_ = middle;
  }

  void arc() {
    double rx = std::abs(coordinate(0));
    scan_.separator();
    double ry = std::abs(coordinate(0));
    scan_.separator();
    const double tilt = coordinate(0) * to_radians;
    scan_.separator();
    const bool large = flag();
    scan_.separator();
    const bool clockwise = flag();
    scan_.separator();
    const auto to = point();
    if (out_.mistake)
      return;
    const auto from = pen_;
    if (rx == 0 || ry == 0 || from == to)
      return line_to(to);
    mark_curve();
    // Source: SVG 1.1 §F.6.5, conversion from end points to centre.
    const double sine = std::sin(tilt);
    const double cosine = std::cos(tilt);
    const Point half{(from.x - to.x) / 2, (from.y - to.y) / 2};
    const Point own{cosine * half.x + sine * half.y, cosine * half.y - sine * half.x};
    const double too_far = own.x * own.x / (rx * rx) + own.y * own.y / (ry * ry);
    if (too_far > 1) {
      rx *= std::sqrt(too_far);
      ry *= std::sqrt(too_far);
    }
    const double shape = rx * rx * own.y * own.y + ry * ry * own.x * own.x;
    const double left = std::max(0.0, rx * rx * ry * ry / shape - 1);
    const double side = (large == clockwise ? -1 : 1) * std::sqrt(left);
    const Point center{side * rx * own.y / ry, -side * ry * own.x / rx};
    const Point middle{cosine * center.x - sine * center.y + (from.x + to.x) / 2,
                       sine * center.x + cosine * center.y + (from.y + to.y) / 2};
    const double first = std::atan2((own.y - center.y) / ry, (own.x - center.x) / rx);
    double sweep = std::atan2((-own.y - center.y) / ry, (-own.x - center.x) / rx) - first;
    if (clockwise && sweep < 0)
      sweep += 2 * pi;
    if (!clockwise && sweep > 0)
      sweep -= 2 * pi;
    pieces(to, [&](double t) {
      const double angle = first + t * sweep;
      const Point on{rx * std::cos(angle), ry * std::sin(angle)};
      return Point{middle.x + cosine * on.x - sine * on.y, middle.y + sine * on.x + cosine * on.y};
    });
  }
  bool flag() {
    if (out_.mistake)
      return false;
    const auto value = scan_.flag();
    if (!value)
      fail(texts::ZeroOrOne());
    return value.value_or(false);
  }

  void fail(Message wanted, Message help = texts::PathsAre()) {
    if (!out_.mistake)
      out_.mistake = scan_.mistake(std::move(wanted), std::move(help));
  }

  Scanner scan_;
  std::size_t most_points_;
  std::size_t points_ = 0;
  Outlines out_;
  bool first_ = true;
  bool relative_ = false;
  char last_ = 'M';
  std::uint32_t begin_ = 0; ///< start of the command
  Point pen_;
  Point control_; ///< of the last curve
};

} // namespace

Matrix Matrix::operator*(const Matrix& inner) const {
  return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
          b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

Numbers read_numbers(std::string_view text) {
  Numbers out;
  Scanner scan(text);
  scan.gaps();
  while (!scan.done()) {
    const auto value = scan.number();
    if (!value) {
      out.mistake = scan.mistake(texts::ANumber(), texts::PartNumbers());
      return out;
    }
    out.values.push_back(*value);
    scan.separator();
  }
  return out;
}

Transform read_transform(std::string_view text) {
  Transform out;
  Scanner scan(text);
  scan.gaps();
  while (!scan.done()) {
    const auto before = scan;
    const auto name = scan.letters();
    const auto* const found =
        std::find_if(functions.begin(), functions.end(),
                     [&](const Function& function) { return function.name == name; });
    scan.gaps();
    std::array<double, 6> values{};
    std::size_t count = 0;
    const bool opened = found != functions.end() && scan.take('(');
    while (opened) {
      scan.separator();
      const auto value = count < values.size() ? scan.number() : std::nullopt;
      if (!value)
        break;
      values[count++] = *value;
    }
    if (!opened || !scan.take(')') || count < found->least || count > found->most) {
      out.mistake = before.mistake(texts::ATransform(), texts::TransformsAre());
      return out;
    }
    out.matrix = out.matrix * found->matrix(values, count);
    scan.separator();
  }
  return out;
}

Outlines read_path(std::string_view text, std::size_t most_points) {
  return Path(text, most_points).read();
}

std::vector<Point> unit_circle() {
  std::vector<Point> ring;
  for (int i = 0; i < circle_pieces; ++i)
    ring.push_back({std::cos(2 * pi * i / circle_pieces), std::sin(2 * pi * i / circle_pieces)});
  return ring;
}

} // namespace orb::report::svg
