#pragma once

#include "run/run.h"
#include "run/tether/recording.h"
#include "run/tether/tether.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

// A run on a robot: the program runs here, the robot is its body (docs/robots.md).

namespace orb::run {

/// What a run on a robot needs beyond its program.
struct TetherOptions {
  spec::Robot robot = spec::Robot::Sphero;
  Aim aim = Aim::Zero;
  TetherBudgets budgets;
  /// Opens the link once more after it was lost; null where it cannot be.
  std::function<std::unique_ptr<protocol::Transport>()> reopen;
  /// What happens is noted here; null for nobody.
  DriveRecording* recording = nullptr;
  /// The program starts now: what is to happen to a virtual robot counts from here. May be null.
  std::function<void()> begins;
  /// Hears sentences for people while it goes on.
  std::function<void(const std::string&)> note;
};

struct TetheredEnding {
  Ending ending;
  std::optional<Failure> failure;          ///< why the run could not go on to its end
  spec::Robot robot = spec::Robot::Sphero; ///< which drove
  std::string left; ///< of a replay: where the program asked for something else; empty where not
};

/// Runs the first program here, with the robot at the other end of `transport` as its body and the
/// time of the link as its time. However the run ends, the robot has been told to stop; whether it
/// has acknowledged that is in the ending. Fails where the run never began.
tl::expected<TetheredEnding, Failure>
run_tethered(std::span<const Input> inputs, const Options& options, Listener& listener,
             report::Journey* journey, protocol::Transport& transport, const TetherOptions& tether);

/// Runs the first program here with what was recorded as its robot: prints, trace and report are
/// those of the recorded run. Where the program asks for something else, it ends.
tl::expected<TetheredEnding, Failure> run_replayed(std::span<const Input> inputs,
                                                   const Options& options, Listener& listener,
                                                   report::Journey* journey,
                                                   const DriveRecording& recording);

} // namespace orb::run
