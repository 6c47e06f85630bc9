#pragma once

#include "cli/robot/link.h"
#include "run/tether/talk_v2.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::cli {

class Command;

/// Adds `--robot`, for links whose name does not identify the robot.
void add_robot_option(const Command& command, std::string& robot);

/// The robot from `--robot`, from the port's name or from Bluetooth LE; nothing if it has to be
/// asked.
std::optional<spec::Robot> told_robot(const Link& link, std::string_view robot);

/// An identified packets v2 robot.
struct Newer {
  const spec::RobotInfo& robot; ///< or another model with the same packets
  std::string title;            ///< as people call it; lists several if it may be any of them
};

Newer newer_of(spec::Robot robot);

/// Identifies a packets v2 robot: `told`, or by asking it. Models with the same packets need not be
/// told apart.
tl::expected<Newer, Failure> find_newer(Link& link, std::optional<spec::Robot> told);

/// What a command does with a greeted ball, and with a packets v2 robot.
struct Talks {
  std::function<ExitCode(Link&, uploader::Session&, const uploader::Greeting&)> classic;
  std::function<tl::expected<void, Failure>(Link&, run::TalkV2&, const Newer&)> newer;
};

/// Opens the link that the options name, identifies the robot and runs the matching function of
/// `talks`; the short commands are written with this. A classic ball answers the greeting; a newer
/// robot answers only packets v2. `robot` is the value of `--robot`, or empty. Prints errors and
/// sets the exit code.
void with_robot(Context& context, const PortOptions& options, std::string_view robot,
                const Talks& talks);

/// The same for features of the main firmware of balls that store programs: refuses a ball in its
/// bootloader, and packets v2 robots.
void with_firmware(
    Context& context, const PortOptions& options,
    const std::function<ExitCode(Link&, uploader::Session&, const uploader::Greeting&)>& work);

/// `a Sphero BOLT`, `an R2-D2`.
std::string with_article(std::string_view title);

/// Explains why a packets v2 robot stores no program, and how to run one with it.
Failure stores_nothing(const Newer& robot, std::string_view port);

/// Adds to a failure that the robot is not the one `--robot` names. Asks only after a failure, so
/// success costs nothing.
Failure name_robot(Link& link, std::string_view robot, Failure failure);

} // namespace orb::cli
