#pragma once

#include "run/run.h"
#include "run/tether/recording.h"
#include "run/tether/tether.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

// A run on a robot: the program runs here, with the robot as its body (docs/using/robots.md).

namespace orb::run {

/// Options of a run on a robot.
struct TetherOptions {
  spec::Robot robot = spec::Robot::Sphero;
  Aim aim = Aim::Zero;
  TetherBudgets budgets;
  Reopen reopen; ///< may be empty
  /// Records the run; may be null.
  DriveRecording* recording = nullptr;
  /// Called when the program starts: events scheduled for a virtual robot count from here. May be
  /// null.
  std::function<void()> begins;
  /// Receives sentences for people during the run.
  std::function<void(const std::string&)> note;
};

struct TetheredEnding {
  Ending ending;
  std::optional<Failure> failure;          ///< why the run could not reach its end
  spec::Robot robot = spec::Robot::Sphero; ///< the robot that drove
  std::string left; ///< where a replay deviated from the recording; empty if it did not
};

/// Runs the first program here, with the robot at the other end of `transport` as its body and the
/// link's time as its time. Sends a stop however the run ends; the ending says whether it was
/// acknowledged. Fails if the run never began.
tl::expected<TetheredEnding, Failure>
run_tethered(std::span<const Input> inputs, const Options& options, Listener& listener,
             report::Journey* journey, protocol::Transport& transport, const TetherOptions& tether);

/// Runs the first program here with a recording as its robot: prints, trace and report equal those
/// of the recorded run. Ends if the program deviates.
tl::expected<TetheredEnding, Failure> run_replayed(std::span<const Input> inputs,
                                                   const Options& options, Listener& listener,
                                                   report::Journey* journey,
                                                   const DriveRecording& recording);

} // namespace orb::run
