#pragma once

#include "playground/engine/log_link.h"
#include "run/tether/tether.h"

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace orb::playground {

/// Returns the robot that advertises this name; a classic ball for other names, as on a serial
/// port.
spec::Robot robot_named(std::string_view name);

/// A robot at the other end of a link held by the browser. Messages carry the bytes that arrived,
/// answers the bytes to send. It is prepared, driven, and stopped at the end.
class Reins {
public:
  explicit Reins(spec::Robot robot);
  ~Reins();

  /// Prepares the robot as an upload does: takes the result of the last wish(); returns the robot's
  /// first sample, or nothing if there is another wish().
  tl::expected<std::optional<vm::Sample>, Failure> ready(const ordered_json& message);
  const ordered_json& wish() const { return wish_; }
  bool is_ready() const { return robot_ != nullptr; }

  /// Takes the bytes that arrived; `relinked`: the link is a new one.
  void take(const ordered_json& message);
  /// The bytes to send, how long to wait for news afterwards and, if they have changed, the packets
  /// that stop the robot if this engine fails: `write`, `wait_ms`, `stop`.
  ordered_json give(double wait_ms);
  Instant now() const;
  run::Tether& robot() { return *robot_; }

  /// Starts stopping the robot.
  void wind_up();
  bool winds_up() const { return ends_at_.has_value(); }
  /// Continues stopping it; returns true once it is over. Passes news to `hear`.
  bool is_wound_up(const std::function<void(const run::RobotMessage&)>& hear);

private:
  class Line;

  spec::Robot kind_;
  run::TetherBudgets budgets_;
  std::vector<Done> log_;
  ordered_json wish_;
  std::unique_ptr<Line> line_;
  std::unique_ptr<run::Tether> robot_;
  Bytes stop_; ///< the last one reported
  std::optional<Instant> ends_at_;
};

} // namespace orb::playground
