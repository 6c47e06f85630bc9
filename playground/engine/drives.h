#pragma once

#include "playground/engine/reins.h"
#include "playground/engine/runs.h"
#include "run/tether/driven.h"

#include <memory>
#include <optional>
#include <string>

namespace orb::playground {

/// A program run here that drives a robot over a link held by the browser. Messages carry the bytes
/// that arrived; their answers carry the bytes to send. Preparing the robot works like an upload;
/// afterwards each message advances the run.
class Drive {
public:
  static tl::expected<std::unique_ptr<Drive>, Problem> start(Request& request);

  /// Takes the bytes from the link, and `stop`. The answer has `wish` (while preparing the robot),
  /// or `write` and `wait_ms`, with the run's `frame` if requested, or `over`.
  Answer step(const ordered_json& message);

  /// The run; null before it begins.
  Run* run() { return run_.get(); }

private:
  explicit Drive(const Request& request);

  Answer ready(const ordered_json& message);
  Answer drive(const ordered_json& message);
  Answer wind_up();
  Answer over();

  SentenceLog& said_;
  ordered_json request_; ///< starts the run when the robot is ready
  run::TetherOptions options_;
  Reins reins_;
  std::unique_ptr<Run> run_;
  std::unique_ptr<run::Driven> driven_;
  bool has_ended_ = false; ///< ended without being stopped
  std::string trouble_;    ///< why it could not continue
};

} // namespace orb::playground
