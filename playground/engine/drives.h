#pragma once

#include "playground/engine/log_link.h"
#include "playground/engine/runs.h"
#include "run/tether/driven.h"

#include <memory>
#include <optional>
#include <string>

namespace orb::playground {

/// A program that drives a robot from here, over a link that a browser holds: what it sends comes
/// in messages, and what is to be sent goes out with their answers. To ready the robot it works as
/// an upload does; after that every message moves the run on.
class Drive {
public:
  static tl::expected<std::unique_ptr<Drive>, Problem> start(Request& request);
  ~Drive();

  /// Takes what came of the link, and `stop`; the answer has `wish` (to ready the robot), or
  /// `write` and `wait_ms`, with the `frame` of the run where one is asked for, or `over`.
  Answer step(const ordered_json& message);

  /// Of the run; null before it has begun.
  Run* run() { return run_.get(); }

private:
  explicit Drive(const Request& request);

  class Line;
  Answer ready(const ordered_json& message);
  Answer drive(const ordered_json& message);
  Answer wind_up(const ordered_json& message);
  Answer go_on(const ordered_json& message, double wait_ms);
  Answer over();

  Said& said_;
  ordered_json request_; ///< of the run, which begins when the robot is ready
  run::TetherOptions options_;
  std::vector<Done> log_;
  std::unique_ptr<Line> line_;
  std::unique_ptr<run::Tether> robot_;
  std::unique_ptr<Run> run_;
  std::unique_ptr<run::Driven> driven_;
  std::optional<Instant> ends_at_; ///< it winds up until then
  bool has_ended_ = false;         ///< by itself
  std::string trouble_;            ///< why it could not go on
};

} // namespace orb::playground
