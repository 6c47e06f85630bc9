#pragma once

#include "run/tether/tether.h"
#include "spec/robots.h"
#include "vm/matrix.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>

namespace orb::run {

/// Manual driving: keys change heading and speed step by step, and the robot stops if no input
/// comes for a while. Large because each input and each value on the display has its own member.
class Pilot {
public:
  /// The robot stops after this time without a key: the user may have walked away.
  static constexpr Duration patience = 5s;

  Pilot(Tether& robot, spec::Robot kind, const vm::Sample& first)
      : robot_(robot), has_matrix_(vm::has_matrix(kind)), sample_(first) {}

  enum class Key : std::uint8_t { Faster, Slower, Left, Right, Stop, Ahead, Color, Lamp };
  void press(Key key);
  /// Drives at a heading in the pilot's axes, 0 <= heading < 360, and 0 <= speed <= 255. Valid for
  /// `patience`.
  void steer(int heading_deg, int speed, Duration patience);
  void stop();
  void show(vm::Color color);

  // The LED matrix. Has no effect on robots without one.
  bool has_matrix() const { return has_matrix_; }
  /// Sets one lamp: 0 <= x, y < 8 from the bottom left. Ignores places outside.
  void paint(int x, int y, vm::Color color);
  /// Scrolls a text once. Cuts it after 25 characters (LIB) and replaces those that are not
  /// printable ASCII by `?`.
  void say(const std::string& text, vm::Color color);
  void clear_matrix();
  /// The picture, as far as this pilot has set it.
  const vm::Matrix::Pixels& picture() const { return matrix_.pixels(); }

  /// Takes news from the robot.
  void hear(const RobotMessage& said);
  /// Stops the robot if no input has come for too long.
  void watch();

  const vm::Sample& sample() const { return sample_; }
  const std::optional<vm::stimulus::Battery>& battery() const { return battery_; }
  /// Returns for example `12 cm right, 40 cm ahead, 34 cm/s, faces 90°, told 90° at 60`.
  std::string words() const;

private:
  void obey(Duration patience);
  void tell_matrix(spec::V2Command command, Bytes data);

  Tether& robot_;
  bool has_matrix_;
  vm::Matrix matrix_; ///< mirrors the robot's matrix
  vm::Sample sample_;
  std::optional<vm::stimulus::Battery> battery_;
  int heading_ = 0; ///< in the pilot's axes
  int speed_ = 0;
  int ahead_ = 0; ///< the robot's heading that the pilot calls 0
  std::size_t color_ = 0;
  bool lamp_ = false;
  std::uint64_t blows_ = 0;
  std::optional<Instant> stops_at_;
};

/// How an attended drive ended.
struct Attended {
  tl::expected<void, Failure> driven;
  bool stopped = false; ///< the robot has acknowledged the stop
};

/// Lets `drive` drive a prepared robot, then stops it whatever happened, even if `drive` threw (see
/// contain()).
Attended drive_attended(Tether& robot, const std::function<tl::expected<void, Failure>()>& drive);

} // namespace orb::run
