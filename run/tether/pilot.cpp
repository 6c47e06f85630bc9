#include "run/tether/pilot.h"

#include "base/contain.h"

#include "spec/ball.h"
#include "spec/basic.h"
#include "spec/colours.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace orb::run {
namespace {

constexpr int turn_deg = 15;
constexpr int speed_step = 20;
constexpr int fastest = 255;
constexpr int lamp_level = 255;

std::string side(double cm, std::string_view plus, std::string_view minus) {
  return fmt::format("{:.0f} cm {}", std::abs(cm), cm < 0 ? minus : plus);
}

} // namespace

void Pilot::press(Key key) {
  switch (key) {
  case Key::Faster: speed_ = std::min(speed_ + speed_step, fastest); break;
  case Key::Slower: speed_ = std::max(speed_ - speed_step, 0); break;
  case Key::Left: heading_ = vm::whole_heading(heading_ - turn_deg); break;
  case Key::Right: heading_ = vm::whole_heading(heading_ + turn_deg); break;
  case Key::Stop: return stop();
  case Key::Ahead: // the direction it faces now
    ahead_ = vm::whole_heading(sample_.yaw_deg);
    heading_ = 0;
    break;
  case Key::Color:
    color_ = (color_ + 1) % spec::led_colours.size();
    return show({spec::led_colours[color_].red, spec::led_colours[color_].green,
                 spec::led_colours[color_].blue});
  case Key::Lamp: lamp_ = !lamp_; return robot_.show_back(lamp_ ? lamp_level : 0);
  }
  obey(patience);
}

void Pilot::steer(int heading_deg, int speed, Duration lasts) {
  heading_ = vm::whole_heading(heading_deg);
  speed_ = std::clamp(speed, 0, fastest);
  obey(lasts);
}

void Pilot::obey(Duration lasts) {
  if (speed_ == 0 && stops_at_)
    return stop();
  robot_.obey(vm::Roll{vm::whole_heading(heading_ + ahead_), speed_, vm::Go::Drive});
  if (speed_ > 0)
    stops_at_ = robot_.now() + lasts;
}

void Pilot::stop() {
  speed_ = 0;
  stops_at_.reset();
  robot_.obey(vm::Roll{vm::whole_heading(heading_ + ahead_), 0, vm::Go::Brake});
}

void Pilot::show(vm::Color color) {
  robot_.show(color);
  matrix_.fill(color);
}

/// Queued, so that lamps painted in quick succession all arrive.
void Pilot::tell_matrix(spec::V2Command command, Bytes data) {
  const auto& row = spec::info(command);
  robot_.send_soon({row.did(), row.cid(), std::move(data), Request::Need::Try});
}

void Pilot::paint(int x, int y, vm::Color color) {
  const auto is_on_it = [](int at) { return at >= 0 && at < vm::Matrix::side; };
  if (!has_matrix_ || !is_on_it(x) || !is_on_it(y))
    return;
  tell_matrix(spec::V2Command::MatrixPixel,
              {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), color.red, color.green,
               color.blue});
  matrix_.pixel(x, y, color);
}

void Pilot::say(const std::string& text, vm::Color color) {
  constexpr std::uint8_t columns_per_second = 10;
  constexpr bool repeats = false;
  constexpr std::size_t longest = 25;
  if (!has_matrix_)
    return;
  auto words = text.substr(0, longest);
  for (auto& character : words)
    if (character < ' ' || character > '~')
      character = '?';
  Bytes data{color.red, color.green, color.blue, columns_per_second, repeats};
  data.insert(data.end(), words.begin(), words.end());
  data.push_back(0);
  tell_matrix(spec::V2Command::MatrixText, std::move(data));
  matrix_.scroll(color, columns_per_second, repeats, words, robot_.now());
}

void Pilot::clear_matrix() {
  if (!has_matrix_)
    return;
  tell_matrix(spec::V2Command::MatrixColor, {0, 0, 0});
  matrix_.clear();
}

void Pilot::hear(const RobotMessage& said) {
  if (const auto* sample = std::get_if<vm::Sample>(&said.what))
    sample_ = *sample;
  else if (const auto* battery = std::get_if<vm::stimulus::Battery>(&said.what))
    battery_ = *battery;
  else if (std::holds_alternative<vm::event::Collision>(said.what))
    ++blows_;
}

void Pilot::watch() {
  matrix_.advance(robot_.now());
  if (stops_at_ && robot_.now() >= *stops_at_)
    stop();
}

std::string Pilot::words() const {
  auto text = fmt::format("{}, {}, {:.0f} cm/s, faces {:.0f}°, told {}° at {}",
                          side(sample_.place_cm.y, "ahead", "behind"),
                          side(sample_.place_cm.x, "right", "left"),
                          std::hypot(sample_.velocity_cm_s.x, sample_.velocity_cm_s.y),
                          sample_.yaw_deg, vm::whole_heading(heading_ + ahead_), speed_);
  if (blows_ > 0)
    text += fmt::format(", {} bump{}", blows_, blows_ == 1 ? "" : "s");
  if (battery_)
    text += fmt::format(", {:.2f} V", battery_->volts);
  return text;
}

Attended drive_attended(Tether& robot, const std::function<tl::expected<void, Failure>()>& drive) {
  auto driven = contain(drive);
  return {std::move(driven), robot.finish()};
}

} // namespace orb::run
