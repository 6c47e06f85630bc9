// Compares the virtual ball with recorded drives of a real one: prints the errors of its numbers
// (spec/ball.def, source DRIVES), or fits numbers to the recordings.
//
//   drives FILE…                       errors of the numbers of spec/ball.def
//   drives --fit FILE…                 numbers fitted to all files, and to each, with the errors
//                                      on the others
//   drives --speeds SVG --path SVG FILE    pictures of half a minute of the first file
//
// A recording is a table: yaw (deg), locator x, y (cm), speed x, y (mm/s), acceleration x, y, time
// since the row before (µs), ordered speed, ordered heading; an order holds from its row on. It is
// driven again in pieces of 12 s; the first 2 s of each only bring the ball up to speed. Nothing
// here is random: the pictures are the same on every machine.

#include "vm/body/body.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/os.h>
#include <fstream>
#include <functional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace orb;
using namespace orb::vm;

struct Row {
  double at_s = 0;
  Point place;
  double speed_cm_s = 0;
  int ordered_speed = 0;
  int ordered_heading_deg = 0;
};

using Drive = std::vector<Row>;

constexpr double piece_s = 12;
constexpr double warm_up_s = 2;
constexpr double window_s = 1;

Drive read_drive(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  Drive rows;
  double at_s = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    double yaw = 0, x = 0, y = 0, vx = 0, vy = 0, ax = 0, ay = 0, wait_us = 0, heading = 0;
    int speed = 0;
    if (!(cells >> yaw >> x >> y >> vx >> vy >> ax >> ay >> wait_us >> speed >> heading))
      continue; // the heading of the table
    at_s += wait_us * 1e-6;
    rows.push_back({at_s, {x, y}, std::hypot(vx, vy) / 10, speed, static_cast<int>(heading)});
  }
  return rows;
}

/// The state of the virtual ball at the times of the requested rows.
struct Sample {
  double at_s = 0;
  Point place;
  double speed_cm_s = 0;
};

/// The rows of one piece, driven again from a standstill.
std::vector<Sample> replay(std::span<const Row> rows, const spec::Driving& numbers) {
  Body body(1, numbers);
  std::vector<Sample> samples;
  for (const auto& row : rows) {
    const double at_s = row.at_s - rows.front().at_s;
    body.advance_to(Instant{} + Duration{static_cast<Duration::rep>(at_s * 1e9)});
    const auto pose = body.pose();
    samples.push_back({at_s, {pose.x_cm, pose.y_cm}, pose.speed_cm_s});
    body.obey(Roll{row.ordered_heading_deg, row.ordered_speed, Go::Drive});
  }
  return samples;
}

/// The place at an instant between two samples.
Point between(std::span<const Sample> samples, double at_s) {
  const auto next = std::lower_bound(samples.begin(), samples.end(), at_s,
                                     [](const Sample& one, double at) { return one.at_s < at; });
  if (next == samples.begin())
    return next->place;
  const auto before = next - 1;
  const double share = (at_s - before->at_s) / (next->at_s - before->at_s);
  return {before->place.x + share * (next->place.x - before->place.x),
          before->place.y + share * (next->place.y - before->place.y)};
}

double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

struct Sums {
  double wrong = 0; ///< squared differences of the displacements
  double right = 0; ///< squared displacements
  double virtual_way = 0;
  double real_way = 0;
  double error() const { return std::sqrt(wrong / right); }
  double speed() const { return virtual_way / real_way; }
};

void compare(std::span<const Row> rows, const spec::Driving& numbers, Sums& sums) {
  const auto samples = replay(rows, numbers);
  std::vector<Sample> real;
  for (const auto& row : rows)
    real.push_back({row.at_s - rows.front().at_s, row.place, row.speed_cm_s});
  for (std::size_t row = 1; row < rows.size(); ++row) {
    const double at_s = real[row].at_s;
    if (real[row - 1].at_s >= warm_up_s) {
      sums.virtual_way += distance(samples[row].place, samples[row - 1].place);
      sums.real_way += distance(real[row].place, real[row - 1].place);
    }
    if (at_s < warm_up_s || at_s + window_s > real.back().at_s)
      continue;
    const auto went = between(real, at_s + window_s);
    const auto goes = between(samples, at_s + window_s);
    const Point there{went.x - real[row].place.x, went.y - real[row].place.y};
    const Point here{goes.x - samples[row].place.x, goes.y - samples[row].place.y};
    sums.wrong += std::pow(distance(there, here), 2);
    sums.right += there.x * there.x + there.y * there.y;
  }
}

Sums compare(const Drive& drive, const spec::Driving& numbers) {
  Sums sums;
  for (std::size_t first = 0; first < drive.size();) {
    std::size_t end = first;
    while (end < drive.size() && drive[end].at_s - drive[first].at_s < piece_s)
      ++end;
    compare(std::span(drive).subspan(first, end - first), numbers, sums);
    first = end;
  }
  return sums;
}

/// The numbers to fit, as a list.
using Numbers = std::vector<double>;

Numbers to_list(const spec::Driving& n) {
  return {n.speed_slope, n.speed_offset, n.speed_lag, n.grip, n.turn_gain};
}

spec::Driving from_list(const Numbers& list, int dead_steps) {
  spec::Driving n;
  n.speed_slope = list[0];
  n.speed_offset = list[1];
  n.speed_lag = std::max(list[2], 0.01);
  n.grip = std::max(list[3], 1.0);
  n.turn_gain = std::max(list[4], 0.1);
  n.dead_steps = dead_steps;
  return n;
}

/// Minimises by the simplex of Nelder and Mead, starting at `at`.
Numbers lowest(Numbers at, const std::function<double(const Numbers&)>& height) {
  const std::size_t n = at.size();
  constexpr int rounds = 150;
  std::vector<std::pair<double, Numbers>> corners{{height(at), at}};
  for (std::size_t axis = 0; axis < n; ++axis) {
    auto corner = at;
    corner[axis] *= 1.2;
    corners.emplace_back(height(corner), corner);
  }
  for (int round = 0; round < rounds; ++round) {
    std::sort(corners.begin(), corners.end());
    const auto beyond = [&](double far) {
      Numbers place(n);
      for (std::size_t axis = 0; axis < n; ++axis) {
        double middle = 0;
        for (std::size_t corner = 0; corner < n; ++corner)
          middle += corners[corner].second[axis] / static_cast<double>(n);
        place[axis] = middle + far * (corners[n].second[axis] - middle);
      }
      return std::pair{height(place), place};
    };
    const auto mirrored = beyond(-1);
    if (mirrored < corners[0])
      corners[n] = std::min(mirrored, beyond(-2));
    else if (mirrored < corners[n - 1])
      corners[n] = mirrored;
    else if (const auto nearer = beyond(0.5); nearer < corners[n])
      corners[n] = nearer;
    else
      for (std::size_t corner = 1; corner <= n; ++corner) {
        for (std::size_t axis = 0; axis < n; ++axis)
          corners[corner].second[axis] =
              (corners[corner].second[axis] + corners[0].second[axis]) / 2;
        corners[corner].first = height(corners[corner].second);
      }
  }
  return std::min_element(corners.begin(), corners.end())->second;
}

/// For each dead time, fits the numbers with the least error among those whose speed is right.
spec::Driving fit(const std::vector<Drive>& drives) {
  spec::Driving best;
  double least = HUGE_VAL;
  for (int dead_steps = 32; dead_steps <= 48; dead_steps += 4) {
    const auto height = [&](const Numbers& list) {
      Sums all;
      for (const auto& drive : drives) {
        const auto sums = compare(drive, from_list(list, dead_steps));
        all.wrong += sums.wrong;
        all.right += sums.right;
        all.virtual_way += sums.virtual_way;
        all.real_way += sums.real_way;
      }
      return all.error() + 4 * std::pow(all.speed() - 1, 2);
    };
    const auto found = lowest(to_list({}), height);
    if (const double error = height(found); error < least) {
      least = error;
      best = from_list(found, dead_steps);
    }
  }
  return best;
}

void print_numbers(const spec::Driving& n) {
  fmt::print(
      "  slope {:.3f}  offset {:.1f} cm/s  lag {:.3f} s  dead time {:.0f} ms  grip {:.0f} cm/s2  "
      "turns {:.2f}\n",
      n.speed_slope, n.speed_offset, n.speed_lag, n.dead_steps * 2.5, n.grip, n.turn_gain);
}

void print_errors(const std::vector<std::string>& names, const std::vector<Drive>& drives,
                  const spec::Driving& numbers) {
  for (std::size_t drive = 0; drive < drives.size(); ++drive) {
    const auto sums = compare(drives[drive], numbers);
    fmt::print("  {}: speed {:.3f} of the real one, displacements {:.1f} % wrong\n", names[drive],
               sums.speed(), 100 * sums.error());
  }
}

struct Picture {
  double width = 640;
  double height = 300;
  std::string body;

  void line(const std::vector<Point>& points, std::string_view color) {
    body +=
        fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" points=\"", color);
    for (const auto& point : points)
      body += fmt::format("{:.1f},{:.1f} ", point.x, point.y);
    body += "\"/>\n";
  }
  void text(Point at, std::string_view text, std::string_view color) {
    body += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" fill=\"{}\">{}</text>\n", at.x, at.y,
                        color, text);
  }
  void save(const std::string& path) const {
    auto out = fmt::output_file(path);
    out.print("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
              "font-family=\"sans-serif\" font-size=\"12\">\n"
              "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#fff\"/>\n{2}</svg>\n",
              width, height, body);
  }
};

constexpr auto ordered_color = "#999";
constexpr auto real_color = "#d95f02";
constexpr auto virtual_color = "#1b6ca8";

/// The pictures show a piece from the middle of the drive.
std::span<const Row> shown_piece(const Drive& drive) {
  const auto from =
      std::find_if(drive.begin(), drive.end(), [](const Row& r) { return r.at_s > 60; });
  const auto to =
      std::find_if(from, drive.end(), [&](const Row& r) { return r.at_s > from->at_s + 14; });
  return {from, to};
}

void draw_speeds(const Drive& drive, const std::string& path) {
  const auto rows = shown_piece(drive);
  const auto samples = replay(rows, {});
  Picture picture;
  std::vector<Point> ordered, real, ours;
  const auto place = [&](std::size_t row, double speed) {
    return Point{40 + samples[row].at_s * 42, 270 - speed * 2.6};
  };
  for (int speed = 0; speed <= 80; speed += 20) {
    picture.line({{40, 270 - speed * 2.6}, {630, 270 - speed * 2.6}}, "#eee");
    picture.text({8, 274 - speed * 2.6}, fmt::format("{}", speed), "#555");
  }
  for (int second = 0; second <= 14; second += 2)
    picture.text({37 + second * 42.0, 290}, fmt::format("{} s", second), "#555");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (row > 0)
      ordered.push_back(place(row, spec::speed_cm_s({}, rows[row - 1].ordered_speed)));
    ordered.push_back(place(row, spec::speed_cm_s({}, rows[row].ordered_speed)));
    ours.push_back(place(row, samples[row].speed_cm_s));
    if (row >= 2) // the recorded speed is noisy: use the mean of three rows
      real.push_back(
          place(row - 1,
                (rows[row - 2].speed_cm_s + rows[row - 1].speed_cm_s + rows[row].speed_cm_s) / 3));
  }
  picture.line(ordered, ordered_color);
  picture.line(real, real_color);
  picture.line(ours, virtual_color);
  picture.text({44, 16}, "cm/s: what the ordered value means", ordered_color);
  picture.text({300, 16}, "the real ball", real_color);
  picture.text({400, 16}, "the virtual ball", virtual_color);
  picture.save(path);
}

void draw_path(const Drive& drive, const std::string& path) {
  const auto rows = shown_piece(drive);
  const auto samples = replay(rows, {});
  const auto from = static_cast<std::size_t>(
      std::find_if(samples.begin(), samples.end(),
                   [](const Sample& one) { return one.at_s >= warm_up_s; }) -
      samples.begin());
  const auto to =
      static_cast<std::size_t>(std::find_if(samples.begin(), samples.end(),
                                            [](const Sample& one) { return one.at_s >= 9; }) -
                               samples.begin());
  Picture picture;
  std::vector<Point> real, ours;
  for (std::size_t row = from; row < to; ++row) {
    real.push_back(
        {rows[row].place.x - rows[from].place.x, rows[from].place.y - rows[row].place.y});
    ours.push_back({samples[row].place.x - samples[from].place.x,
                    samples[from].place.y - samples[row].place.y});
  }
  Point least = real.front(), most = real.front();
  for (const auto* way : {&real, &ours})
    for (const auto& at : *way) {
      least = {std::min(least.x, at.x), std::min(least.y, at.y)};
      most = {std::max(most.x, at.x), std::max(most.y, at.y)};
    }
  constexpr double scale = 3;
  for (auto* way : {&real, &ours})
    for (auto& at : *way)
      at = {30 + (at.x - least.x) * scale, 40 + (at.y - least.y) * scale};
  picture.height = 90 + (most.y - least.y) * scale;
  picture.line(real, real_color);
  picture.line(ours, virtual_color);
  picture.line({{20, picture.height - 15}, {80, picture.height - 15}}, "#555");
  picture.text({20, picture.height - 21}, "20 cm", "#555");
  picture.text({20, 16}, "the real ball", real_color);
  picture.text({120, 16}, "the virtual ball", virtual_color);
  picture.save(path);
}

} // namespace

int main(int count, char** words) {
  std::string speeds, path;
  bool fitting = false;
  std::vector<std::string> names;
  for (int word = 1; word < count; ++word) {
    const std::string text = words[word];
    if (text == "--fit")
      fitting = true;
    else if ((text == "--speeds" || text == "--path") && word + 1 < count)
      (text == "--speeds" ? speeds : path) = words[++word];
    else
      names.push_back(text);
  }
  std::vector<Drive> drives;
  for (const auto& name : names) {
    drives.push_back(read_drive(name));
    if (drives.back().empty()) {
      fmt::print(stderr, "drives: {}: no rows of a drive\n", name);
      return 2;
    }
  }
  if (drives.empty()) {
    fmt::print(stderr, "usage: drives [--fit] [--speeds SVG] [--path SVG] FILE...\n");
    return 2;
  }
  fmt::print("the numbers of spec/ball.def\n");
  print_numbers({});
  print_errors(names, drives, {});
  if (fitting) {
    fmt::print("fitted to all of them\n");
    const auto all = fit(drives);
    print_numbers(all);
    print_errors(names, drives, all);
    for (std::size_t drive = 0; drive < drives.size() && drives.size() > 1; ++drive) {
      fmt::print("fitted to {} alone\n", names[drive]);
      const auto one = fit({drives[drive]});
      print_numbers(one);
      print_errors(names, drives, one);
    }
  }
  if (!speeds.empty())
    draw_speeds(drives.front(), speeds);
  if (!path.empty())
    draw_path(drives.front(), path);
}
