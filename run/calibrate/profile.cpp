#include "run/calibrate/profile.h"

#include "base/text/suggest.h"
#include "base/text/text.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace orb::run {
namespace {

struct Line {
  std::size_t number = 0;
  std::string_view key;
  std::string_view value;
};

std::string wrong(const Line& line, std::string_view what) {
  return fmt::format("line {}: {}", line.number, what);
}

tl::expected<std::vector<Line>, std::string> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = trim(line.substr(0, line.find_first_of("#\r")));
    if (line.empty())
      continue;
    const auto equals = line.find('=');
    if (equals == line.npos)
      return tl::unexpected(fmt::format("line {}: `{}` is not `name = number`", number, line));
    lines.push_back({number, trim(line.substr(0, equals)), trim(line.substr(equals + 1))});
  }
  return lines;
}

const DrivingRow* find_row(std::string_view name) {
  for (const auto& row : driving_rows)
    if (row.name == name)
      return &row;
  return full_speed_row.name == name ? &full_speed_row : nullptr;
}

tl::expected<void, std::string> take_robot(const Line& line, Profile& profile) {
  const auto quoted =
      line.value.size() >= 2 && line.value.front() == '"' && line.value.back() == '"';
  const auto* found =
      quoted ? spec::find_robot(line.value.substr(1, line.value.size() - 2)) : nullptr;
  if (found == nullptr)
    return tl::unexpected(
        wrong(line, fmt::format("{} is not a robot; write one such as \"sphero\"", line.value)));
  profile.robot = found->robot;
  profile.driving = spec::driving(found->robot);
  return {};
}

tl::expected<double, std::string> read_number(const Line& line, double least, double most) {
  const auto number = parse_number<double>(line.value);
  if (!number || !(*number >= least && *number <= most))
    return tl::unexpected(wrong(line, fmt::format("`{}` must be a number from {} to {}, not {}",
                                                  line.key, least, most, line.value)));
  return *number;
}

tl::expected<void, std::string> take_number(const Line& line, Profile& profile) {
  if (const auto* row = find_row(line.key)) {
    const auto number = read_number(line, row->least, row->most);
    if (!number)
      return tl::unexpected(number.error());
    set_value(profile.driving, *row, *number);
    return {};
  }
  if (line.key == "slowest" || line.key == "fastest") {
    const auto number = read_number(line, 0, spec::ball::greatest);
    if (!number)
      return tl::unexpected(number.error());
    (line.key == "slowest" ? profile.slowest : profile.fastest) = static_cast<int>(*number);
    return {};
  }
  std::vector<std::string_view> names{"robot", "slowest", "fastest", full_speed_row.name};
  for (const auto& row : driving_rows)
    names.push_back(row.name);
  return tl::unexpected(
      wrong(line, fmt::format("unknown profile entry `{}`; {}", line.key,
                              did_you_mean(line.key, names, "the first line names the robot"))));
}

std::string row_line(const spec::Driving& numbers, const DrivingRow& row) {
  return fmt::format("{} = {:.4g}{}{}\n", row.name, value_of(numbers, row),
                     row.unit.empty() ? "" : " # ", row.unit);
}

} // namespace

double value_of(const spec::Driving& numbers, const DrivingRow& row) {
  return row.place == nullptr ? numbers.dead_steps * dead_step_ms : numbers.*row.place;
}

void set_value(spec::Driving& numbers, const DrivingRow& row, double value) {
  if (row.place == nullptr)
    numbers.dead_steps = static_cast<int>(std::lround(value / dead_step_ms));
  else
    numbers.*row.place = value;
}

std::string to_text(const Profile& profile) {
  auto text = fmt::format("# How a robot drives, measured by `orb calibrate`.\nrobot = \"{}\"\n",
                          spec::info(profile.robot).name);
  for (const auto& row : driving_rows)
    text += row_line(profile.driving, row);
  text += fmt::format("# Not measured: what it does at 255, and at speeds other than these.\n");
  text += row_line(profile.driving, full_speed_row);
  text += fmt::format("slowest = {}\nfastest = {}\n", profile.slowest, profile.fastest);
  return text;
}

tl::expected<Profile, std::string> parse_profile(std::string_view text) {
  const auto lines = lines_of(text);
  if (!lines)
    return tl::unexpected(lines.error());
  if (lines->empty() || lines->front().key != "robot")
    return tl::unexpected(std::string("the first line of a profile must be `robot = \"sphero\"`"));
  Profile profile;
  if (auto taken = take_robot(lines->front(), profile); !taken)
    return tl::unexpected(taken.error());
  for (auto line = lines->begin() + 1; line != lines->end(); ++line)
    if (auto taken = take_number(*line, profile); !taken)
      return tl::unexpected(taken.error());
  if (profile.slowest > profile.fastest)
    return tl::unexpected(std::string("`slowest` is above `fastest`"));
  return profile;
}

} // namespace orb::run
