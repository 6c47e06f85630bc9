#pragma once

#include "cli/context/context.h"
#include "cli/robot/sleep.h"
#include "cli/run/run_console.h"
#include "report/journey.h"
#include "run/input.h"
#include "run/tether/run_tethered.h"

#include <optional>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// True if the options name `sim:`, which has a simulated world.
bool drives_virtual(const Context& context, const RunOptions& given);

/// Rejects options that only a simulation supports.
tl::expected<void, Failure> check_for_robot(const Context& context, const RunOptions& given,
                                            const run::Options& options);

/// A run on a robot, and the result of `--sleep`.
struct OnRobot {
  run::TetheredEnding driven;
  std::optional<Slept> slept{};
};

/// Runs the program with the robot at `given.port` as its body.
tl::expected<OnRobot, Failure> run_on_robot(const Context& context, const RunOptions& given,
                                            const run::Options& options,
                                            const std::vector<run::Input>& inputs, Console& console,
                                            report::Journey* journey);

/// Runs the program with the recording `given.replay` as its robot.
tl::expected<OnRobot, Failure> replay_drive(const RunOptions& given, const run::Options& options,
                                            const std::vector<run::Input>& inputs, Console& console,
                                            report::Journey* journey);

/// The result of stopping the robot at the end, for people.
std::string_view stop_note(const run::Ending& ending);

} // namespace orb::cli
