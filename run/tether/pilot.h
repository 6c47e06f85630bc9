#pragma once

#include "run/tether/run_tethered.h"
#include "run/tether/tether.h"
#include "spec/robots.h"
#include "vm/matrix.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

namespace orb::run {

/// Somebody who drives a robot by hand: headings and speeds add up key by key, and the robot stops
/// where nothing comes for a while.
class Pilot {
public:
  /// Without a key for so long the robot stops: somebody may have walked away.
  static constexpr Duration patience = 5s;

  Pilot(Tether& robot, spec::Robot kind, const vm::Sample& first)
      : robot_(robot), has_matrix_(vm::has_matrix(kind)), sample_(first) {}

  enum class Key : std::uint8_t { Faster, Slower, Left, Right, Stop, Ahead, Color, Lamp };
  void press(Key key);
  /// 0 <= heading < 360 as the pilot counts it, 0 <= speed <= 255. Holds for `patience`, too.
  void steer(int heading_deg, int speed, Duration patience);
  void stop();
  void show(vm::Color color);

  // On its matrix; a robot without one is told nothing.
  bool has_matrix() const { return has_matrix_; }
  /// One lamp: 0 <= x, y < 8 from the bottom left; others are left alone.
  void paint(int x, int y, vm::Color color);
  /// A text that scrolls over it once: at most 25 characters, the rest is cut off (LIB); `?` for
  /// what is no printable ASCII.
  void say(const std::string& text, vm::Color color);
  void clear_matrix();
  /// What it shows, as far as this pilot has told it.
  const vm::Matrix::Pixels& picture() const { return matrix_.pixels(); }

  /// What the robot says.
  void hear(const Said& said);
  /// Stops the robot where nothing came for too long.
  void watch();

  const vm::Sample& sample() const { return sample_; }
  const std::optional<vm::stimulus::Battery>& battery() const { return battery_; }
  int heading() const { return heading_; }
  int speed() const { return speed_; }
  std::uint64_t blows() const { return blows_; }
  /// `12 cm right, 40 cm ahead, 34 cm/s, faces 90°, told 90° at 60`.
  std::string words() const;

private:
  void obey(Duration patience);
  void tell_matrix(spec::V2Command command, Bytes data);

  Tether& robot_;
  bool has_matrix_;
  vm::Matrix matrix_; ///< shows what the robot's does
  vm::Sample sample_;
  std::optional<vm::stimulus::Battery> battery_;
  int heading_ = 0; ///< as the pilot counts it
  int speed_ = 0;
  int ahead_ = 0; ///< the robot's own heading that the pilot calls 0
  std::size_t color_ = 0;
  bool lamp_ = false;
  std::uint64_t blows_ = 0;
  std::optional<Instant> stops_at_;
};

/// How a drive under somebody's eyes ended.
struct Attended {
  tl::expected<void, Failure> driven;
  bool stopped = false;                      ///< the robot has acknowledged the stop
  std::unique_ptr<protocol::Transport> link; ///< over which, where the first was lost
};

/// Lets `drive` drive a robot that has been readied, then stops it, whatever became of the drive:
/// also of one that threw (see contain()). Where the link was lost, it is opened again for that.
Attended drive_attended(Tether& robot, const TetherOptions& tether,
                        const std::function<tl::expected<void, Failure>()>& drive);

} // namespace orb::run
