#include "run/tether/recording.h"

#include "base/text/text.h"

#include <array>
#include <fmt/format.h>
#include <utility>

namespace orb::run {
namespace {

constexpr std::string_view schema = "orb.drive/1";

/// The numbers of a sample, in file order.
template <class Sample>
auto numbers_of(Sample& s) {
  return std::array{&s.place_cm.x,       &s.place_cm.y,       &s.velocity_cm_s.x,
                    &s.velocity_cm_s.y,  &s.yaw_deg,          &s.pitch_deg,
                    &s.roll_deg,         &s.acceleration_g.x, &s.acceleration_g.y,
                    &s.acceleration_g.z, &s.rotation_deg_s.x, &s.rotation_deg_s.y,
                    &s.rotation_deg_s.z};
}
template <class Quaternion>
auto numbers_of_attitude(Quaternion& q) {
  return std::array{&q.x, &q.y, &q.z, &q.w};
}
template <class Collision>
auto numbers_of_collision(Collision& c) {
  return std::array{&c.x, &c.y, &c.axis, &c.x_magnitude, &c.y_magnitude, &c.speed};
}

std::string words_of(const vm::Sample& sample) {
  std::string text;
  for (const auto* number : numbers_of(sample))
    text += fmt::format(" {}", *number);
  if (sample.attitude)
    for (const auto* number : numbers_of_attitude(*sample.attitude))
      text += fmt::format(" {}", *number);
  return text;
}

/// Splits a line into words.
class Words {
public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    rest_ = trim(rest_);
    const auto word = rest_.substr(0, rest_.find(' '));
    rest_.remove_prefix(word.size());
    return word;
  }
  std::string_view rest() const { return trim(rest_); }
  template <class Number>
  bool read(Number& number) {
    const auto word = next();
    const auto* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    return error == std::errc{} && stop == end;
  }

private:
  std::string_view rest_;
};

bool read_sample(Words& words, vm::Sample& sample) {
  for (auto* number : numbers_of(sample))
    if (!words.read(*number))
      return false;
  if (words.rest().empty())
    return true;
  for (auto* number : numbers_of_attitude(sample.attitude.emplace()))
    if (!words.read(*number))
      return false;
  return words.rest().empty();
}

bool read_what(std::string_view kind, Words& words, DriveLine& line) {
  if (kind == "sample")
    return read_sample(words, line.what.emplace<vm::Sample>());
  if (kind == "told") {
    line.what = DriveLine::SentCommand{std::string(words.rest())};
    return true;
  }
  if (kind == "over") {
    line.what = DriveLine::Over{};
    return words.rest().empty();
  }
  if (kind == "battery")
    return words.read(line.what.emplace<vm::stimulus::Battery>().volts);
  if (kind == "number")
    return words.read(line.what.emplace<DriveLine::Number>().value);
  if (kind != "collision")
    return false;
  for (auto* number : numbers_of_collision(line.what.emplace<vm::event::Collision>()))
    if (!words.read(*number))
      return false;
  return true;
}

/// Parses the first and last lines, which describe the whole run.
bool read_whole(std::string_view kind, Words& words, DriveRecording& recording) {
  if (kind == "robot") {
    const auto* robot = spec::find_robot(words.next());
    if (robot != nullptr)
      recording.robot = robot->robot;
    return robot != nullptr;
  }
  if (kind == "first")
    return read_sample(words, recording.first);
  if (kind == "stopped") {
    recording.stopped = true;
    return true;
  }
  int code = 0;
  if (kind != "failure" || !words.read(code))
    return false;
  recording.failure = Failure{static_cast<ExitCode>(code), std::string(words.rest())};
  return true;
}

} // namespace

std::string to_text(const DriveRecording& recording) {
  auto text = fmt::format("{}\nrobot {}\nfirst{}\n", schema, spec::info(recording.robot).name,
                          words_of(recording.first));
  for (const auto& [at, what] : recording.lines) {
    text += fmt::format("{} ", at.count());
    if (const auto* sample = std::get_if<vm::Sample>(&what))
      text += "sample" + words_of(*sample);
    else if (const auto* command = std::get_if<DriveLine::SentCommand>(&what))
      text += "told " + command->words;
    else if (const auto* battery = std::get_if<vm::stimulus::Battery>(&what))
      text += fmt::format("battery {}", battery->volts);
    else if (const auto* number = std::get_if<DriveLine::Number>(&what))
      text += fmt::format("number {}", number->value);
    else if (const auto* collision = std::get_if<vm::event::Collision>(&what)) {
      text += "collision";
      for (const auto* value : numbers_of_collision(*collision))
        text += fmt::format(" {}", *value);
    } else
      text += "over";
    text += '\n';
  }
  if (recording.stopped)
    text += "stopped\n";
  if (recording.failure)
    text += fmt::format("failure {} {}\n", static_cast<int>(recording.failure->code),
                        recording.failure->message);
  return text;
}

tl::expected<DriveRecording, std::string> parse_drive_recording(std::string_view text) {
  DriveRecording recording;
  int row = 0;
  bool known = false;
  while (!text.empty()) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    ++row;
    if (!known) {
      known = line == schema;
      if (!known)
        return tl::unexpected(
            fmt::format("not a recording of a drive: its first line is not `{}`", schema));
      continue;
    }
    Words words(line);
    const auto first = words.next();
    const auto at = parse_number<std::int64_t>(first);
    DriveLine entry;
    if (at && *at >= 0 && read_what(words.next(), words, entry)) {
      entry.at = Duration(*at);
      if (!recording.lines.empty() && entry.at < recording.lines.back().at)
        return tl::unexpected(
            fmt::format("line {} has an earlier time than the line before it", row));
      recording.lines.push_back(std::move(entry));
    } else if (at || !read_whole(first, words, recording))
      return tl::unexpected(fmt::format("line {} is damaged: `{}`", row, line.substr(0, 60)));
  }
  if (!known)
    return tl::unexpected(std::string("it is empty"));
  return recording;
}

void Witness::obey(const vm::Motion& motion) {
  struct {
    std::string operator()(const vm::Roll& roll) const {
      return fmt::format("roll {} {} {}", roll.heading_deg, roll.speed, static_cast<int>(roll.go));
    }
    std::string operator()(const vm::Rotate& turn) const {
      return fmt::format("rotate {} {}", turn.angle_deg, turn.time.count());
    }
    std::string operator()(const vm::Motors& motors) const {
      return fmt::format("motors {} {} {} {}", static_cast<int>(motors.left.mode),
                         motors.left.power, static_cast<int>(motors.right.mode),
                         motors.right.power);
    }
    std::string operator()(const vm::SetHeading& name) const {
      return fmt::format("heading {}", name.heading_deg);
    }
    std::string operator()(const vm::SetSpeed& change) const {
      return fmt::format("speed {}", change.speed);
    }
    std::string operator()(const vm::Stabilization& mode) const {
      return fmt::format("stabilization {}", static_cast<int>(mode));
    }
    std::string operator()(const vm::RotationRate& rate) const {
      return fmt::format("rate {}", rate.deg_per_s);
    }
    std::string operator()(const vm::Stop&) const { return "stop"; }
  } words;
  hear_(std::visit(words, motion));
  if (robot_ != nullptr)
    robot_->obey(motion);
}

void Witness::show(vm::Color color) {
  hear_(fmt::format("led {} {} {}", color.red, color.green, color.blue));
  if (robot_ != nullptr)
    robot_->show(color);
}

void Witness::show_back(int level) {
  hear_(fmt::format("back {}", level));
  if (robot_ != nullptr)
    robot_->show_back(level);
}

} // namespace orb::run
