#include "report/journey.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::report {
namespace {

// Capacities that keep any report well below a megabyte.
constexpr std::size_t pose_capacity = 8000;
constexpr std::size_t led_capacity = 6000;
constexpr std::size_t back_led_capacity = 2000;
constexpr std::size_t picture_capacity = 500; // of 400 bytes each
constexpr std::size_t place_capacity = 12000;
constexpr std::size_t variables_capacity = 12000; // of all variables together
constexpr std::size_t least_variable_capacity = 100;
constexpr std::size_t sensor_capacity = 3000;
constexpr std::size_t listed_at_each_end = 1000;
constexpr std::size_t text_limit = 200;
constexpr Duration sensor_period = std::chrono::milliseconds{20};

std::int32_t rounded(double value) {
  return static_cast<std::int32_t>(std::lround(value));
}

} // namespace

std::string_view to_string(Happening::Kind kind) {
  switch (kind) {
  case Happening::Kind::Print: return "print";
  case Happening::Kind::Error: return "error";
  case Happening::Kind::Marker: return "marker";
  case Happening::Kind::Bump: return "bump";
  case Happening::Kind::Collision: return "collision";
  case Happening::Kind::Macro: return "macro";
  case Happening::Kind::Sleep: return "sleep";
  }
  return "";
}

Journey::Journey()
    : poses_(pose_capacity), led_(led_capacity), back_led_(back_led_capacity),
      pictures_(picture_capacity), places_(place_capacity), sensors_(sensor_capacity) {}

int Journey::add_file(std::string name, std::string text) {
  files_.push_back({std::move(name), std::move(text), {}});
  return static_cast<int>(files_.size()) - 1;
}

void Journey::map_line(int robot_line, Place place) {
  lines_.insert_or_assign(robot_line, place);
}

void Journey::map_command(int macro, int command, Place place) {
  commands_.emplace(std::pair{macro, command}, place);
}

void Journey::set_variables(const std::vector<std::pair<std::string, std::string>>& names) {
  if (names.empty())
    return;
  const auto capacity = std::max(variables_capacity / names.size(), least_variable_capacity);
  for (const auto& [name, owner] : names)
    variables_.push_back({name, owner, Series<std::int32_t>(capacity)});
}

void Journey::note(Duration t, std::size_t variable, std::int32_t value) {
  auto& values = variables_[variable].values;
  const auto before = values.empty() ? 0 : values.entries().back().value;
  if (value != before)
    values.push(t, value);
}

void Journey::happen(Duration t, Happening::Kind kind, std::string text, std::string label) {
  ++totals_.happenings[static_cast<std::size_t>(kind)];
  if (text.size() > text_limit)
    text.resize(text_limit);
  Happening happening{t, kind, std::move(text), std::move(label), pose_};
  if (first_.size() < listed_at_each_end) {
    first_.push_back(std::move(happening));
    return;
  }
  last_.push_back(std::move(happening));
  if (last_.size() > listed_at_each_end)
    last_.pop_front();
}

void Journey::visit(Duration t, Place place) {
  auto [count, fresh] = counts_.try_emplace(place, Count{0, t});
  ++count->second.times;
  places_.push(t, place);
}

std::string Journey::where(int robot_line) const {
  const auto found = lines_.find(robot_line);
  if (error_place_ == ErrorPlace::RobotLine || found == lines_.end())
    return fmt::format("line {}", robot_line);
  return fmt::format("{}:{}", files_[static_cast<std::size_t>(found->second.file)].name,
                     found->second.line);
}

void Journey::add(Duration t, const vm::Event& event) {
  std::visit([&](const auto& seen) { see(t, seen); }, event);
}

void Journey::see(Duration t, const vm::event::Print& seen) {
  print(t, seen.text);
}

void Journey::see(Duration t, const vm::event::Error& seen) {
  if (const auto found = lines_.find(seen.line); found != lines_.end())
    files_[static_cast<std::size_t>(found->second.file)].failed.push_back(found->second.line);
  end_.fault = fmt::format("{}: {}", where(seen.line), spec::info(seen.code).text);
  happen(t, Happening::Kind::Error, end_.fault);
}

void Journey::see(Duration t, const vm::event::Led& seen) {
  led_.push(t, seen.color);
}

void Journey::see(Duration t, const vm::event::BackLed& seen) {
  back_led_.push(t, seen.value);
}

void Journey::see(Duration t, const vm::event::Matrix& seen) {
  pictures_.push(t, seen.pixels);
}

void Journey::see(Duration t, const vm::event::Position& seen) {
  if (pose_)
    totals_.distance_cm += std::hypot(seen.pose.x_cm - pose_->x_cm, seen.pose.y_cm - pose_->y_cm);
  totals_.top_speed_cm_s = std::max(totals_.top_speed_cm_s, seen.pose.speed_cm_s);
  pose_ = seen.pose;
  poses_.push(t, seen.pose);
}

void Journey::see(Duration t, const vm::event::Marker& seen) {
  happen(t, Happening::Kind::Marker,
         fmt::format("marker {} (macro {}, command {})", seen.marker, seen.macro, seen.command),
         std::to_string(seen.marker));
}

void Journey::see(Duration t, const vm::event::Macro& seen) {
  ++totals_.commands;
  if (const auto found = commands_.find({seen.id, seen.command}); found != commands_.end())
    visit(t, found->second);
  if (seen.command == 1)
    happen(t, Happening::Kind::Macro, fmt::format("macro {} starts", seen.id));
}

void Journey::see(Duration t, const vm::event::Line& seen) {
  ++totals_.lines;
  if (const auto found = lines_.find(seen.line); found != lines_.end())
    visit(t, found->second);
}

void Journey::see(Duration t, const vm::event::Collision& seen) {
  happen(t, Happening::Kind::Collision,
         fmt::format("collision: x {}, y {}, speed {}", seen.x_magnitude, seen.y_magnitude,
                     seen.speed));
}

void Journey::see(Duration t, const vm::event::Bump& seen) {
  happen(t, Happening::Kind::Bump, fmt::format("{} at speed {}", vm::words_of(seen), seen.speed));
}

void Journey::see(Duration t, const vm::event::Sleep& seen) {
  happen(t, Happening::Kind::Sleep,
         seen.seconds == 0 ? std::string("sleeps until it is woken")
                           : fmt::format("sleeps for {} s", seen.seconds));
}

void Journey::see(Duration, const vm::event::End& seen) {
  totals_.lines = std::max(totals_.lines, seen.lines);
}

void Journey::see(Duration t, const vm::event::StopLost&) {
  happen(t, Happening::Kind::Error, "the robot has not acknowledged the stop");
}

void Journey::set_course(Course course) {
  walls_.insert(walls_.begin(), course.walls.begin(), course.walls.end());
  course_ = std::move(course);
}

void Journey::explain(const std::string& why) {
  if (why.empty() || end_.fault.empty())
    return;
  end_.fault += ": " + why;
  (last_.empty() ? first_.back() : last_.back()).text = end_.fault;
}

void Journey::sample(Duration t, const vm::Body& body) {
  if (!sensors_.empty() && t - sensors_.entries().back().t < sensor_period)
    return;
  const auto acceleration = body.acceleration_g();
  const auto rotation = body.rotation_deg_s();
  sensors_.push(t, {{rounded(body.pitch_deg()), rounded(body.roll_deg()),
                     rounded(1000 * acceleration.x), rounded(1000 * acceleration.y),
                     rounded(1000 * acceleration.z), rounded(1000 * body.acceleration_total_g()),
                     rounded(10 * rotation.x), rounded(10 * rotation.y), rounded(10 * rotation.z),
                     rounded(100 * body.battery_v()), body.stabilized() ? 1 : 0}});
}

/// Joins prints into lines, each with the time of its end.
void Journey::print(Duration t, std::string_view text) {
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos;
       text.remove_prefix(end + 1), line_.clear())
    happen(t, Happening::Kind::Print, line_.append(text.substr(0, end + 1)));
  // Truncate an unfinished line as the list would.
  line_.append(text.substr(0, text_limit - std::min(text_limit, line_.size())));
}

void Journey::finish(Duration t, std::string reason, std::string words) {
  if (!line_.empty())
    happen(t, Happening::Kind::Print, std::exchange(line_, {}));
  end_.t = t;
  end_.reason = std::move(reason);
  end_.words = std::move(words);
}

Journey::Listed Journey::listed() const {
  Listed listed{first_, first_.size(), 0};
  std::uint64_t total = 0;
  for (const auto count : totals_.happenings)
    total += count;
  listed.left_out = total - first_.size() - last_.size();
  listed.happenings.insert(listed.happenings.end(), last_.begin(), last_.end());
  return listed;
}

bool Journey::thinned() const {
  return poses_.quantum() > Duration{} || led_.quantum() > Duration{} ||
         places_.quantum() > Duration{} || sensors_.quantum() > Duration{} ||
         back_led_.quantum() > Duration{} || pictures_.quantum() > Duration{} ||
         std::any_of(variables_.begin(), variables_.end(),
                     [](const Variable& one) { return one.values.quantum() > Duration{}; });
}

} // namespace orb::report
