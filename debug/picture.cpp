#include "debug/picture.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace orb::debug {
namespace {

constexpr int columns = 60;
constexpr int rows = 20;
constexpr double wider_than_high = 2; ///< aspect ratio of a character

/// A grid of characters that covers a part of the plane.
class Field {
public:
  explicit Field(const std::vector<vm::Point>& points) {
    double right = points.front().x;
    double top = points.front().y;
    left_ = right;
    bottom_ = top;
    for (const auto& point : points) {
      left_ = std::min(left_, point.x);
      right = std::max(right, point.x);
      bottom_ = std::min(bottom_, point.y);
      top = std::max(top, point.y);
    }
    scale_ = std::max({1.0, std::ceil((right - left_) / (columns - 1)),
                       std::ceil((top - bottom_) / (rows - 1) / wider_than_high)});
    width_ = column(right) + 1;
    lines_.assign(static_cast<std::size_t>(row(top)) + 1,
                  std::string(static_cast<std::size_t>(width_), ' '));
  }

  double scale() const { return scale_; }
  void put(vm::Point point, char what) {
    const int x = column(point.x);
    const int y = row(point.y);
    if (x >= 0 && x < width_ && y >= 0 && y < static_cast<int>(lines_.size()))
      lines_[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = what;
  }
  void line(vm::Point from, vm::Point to, char what) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const int steps = std::min(1000, static_cast<int>(length / scale_) + 1);
    for (int i = 0; i <= steps; ++i)
      put({from.x + (to.x - from.x) * i / steps, from.y + (to.y - from.y) * i / steps}, what);
  }
  /// Draws an infinite wall across the grid.
  void wall(const vm::Wall& wall) {
    const double right = left_ + scale_ * width_;
    const double top = bottom_ + scale_ * wider_than_high * static_cast<double>(lines_.size());
    if (wall.axis == vm::Wall::Axis::None)
      line(wall.from, wall.to, '#');
    else if (wall.axis == vm::Wall::Axis::X)
      line({wall.at_cm, bottom_}, {wall.at_cm, top}, '#');
    else
      line({left_, wall.at_cm}, {right, wall.at_cm}, '#');
  }
  std::string text() const {
    std::string out;
    for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
      const auto end = line->find_last_not_of(' ');
      out += line->substr(0, end == std::string::npos ? 0 : end + 1) + "\n";
    }
    return out;
  }

private:
  int column(double x) const { return static_cast<int>(std::lround((x - left_) / scale_)); }
  int row(double y) const {
    return static_cast<int>(std::lround((y - bottom_) / scale_ / wider_than_high));
  }

  double left_ = 0;
  double bottom_ = 0;
  double scale_ = 1;
  int width_ = 1;
  std::vector<std::string> lines_; ///< from bottom to top
};

} // namespace

std::string picture(const report::Journey& journey) {
  std::vector<vm::Point> points{{0, 0}};
  for (const auto& entry : journey.poses().entries())
    points.push_back({entry.value.x_cm, entry.value.y_cm});
  const auto path = points;
  for (const auto& wall : journey.walls()) {
    if (wall.axis == vm::Wall::Axis::None) {
      points.push_back(wall.from);
      points.push_back(wall.to);
    } else {
      points.push_back(wall.axis == vm::Wall::Axis::X ? vm::Point{wall.at_cm, 0}
                                                      : vm::Point{0, wall.at_cm});
    }
  }
  Field field(points);
  for (const auto& wall : journey.walls())
    field.wall(wall);
  for (std::size_t i = 1; i < path.size(); ++i)
    field.line(path[i - 1], path[i], '.');
  field.put(path.front(), 'S');
  field.put(path.back(), 'O');
  return fmt::format("{}one character is {:.0f} cm wide and {:.0f} cm high\n", field.text(),
                     field.scale(), field.scale() * wider_than_high);
}

} // namespace orb::debug
