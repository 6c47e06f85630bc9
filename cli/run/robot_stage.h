#pragma once

#include "cli/robot/driven_robot.h"
#include "run/tether/drive_home.h"
#include "testing/run_suite.h"

#include <cstdint>
#include <optional>
#include <tl/expected.hpp>

namespace orb::cli {

/// Tells if somebody is next to the robot.
enum class Attended : std::uint8_t { Yes, No };

/// Runs tests on a robot, one case at a time. Before each case the robot drives back to its mark,
/// and the person next to it is told what to do by hand.
class RobotStage {
public:
  /// `cases`: how many will run.
  RobotStage(DrivenRobot& robot, Attended attended, std::uint64_t cases)
      : robot_(robot), attended_(attended), cases_(cases) {}

  /// Runs a case; fails if that is impossible. After a lost link or an interruption no more cases
  /// can run.
  tl::expected<run::Ending, Failure> play(const testing::Suite& suite, const testing::Group& group,
                                          const run::Options& options, run::Listener& listener,
                                          report::Journey& journey);

  /// Why no more cases can run; nothing if they can.
  const std::optional<Failure>& broken() const { return broken_; }

private:
  tl::expected<void, Failure> ready(const testing::Suite& suite, const testing::Group& group,
                                    const run::Options& options);
  tl::expected<void, Failure> await_hands(const testing::Suite& suite, const testing::Group& group,
                                          const run::Options& options, run::Home home);

  DrivenRobot& robot_;
  Attended attended_;
  std::uint64_t cases_;
  std::uint64_t begun_ = 0;
  std::optional<Failure> broken_;
};

} // namespace orb::cli
