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

/// Adds `--robot`, for links whose name does not tell which robot answers there.
void add_robot_option(const Command& command, std::string& robot);

/// The robot that `--robot` names, or its name in the port or over Bluetooth LE; nothing where it
/// has to be asked.
std::optional<spec::Robot> told_robot(const Link& link, std::string_view robot);

/// A robot of packets v2 that has been found.
struct Newer {
  const spec::RobotInfo& robot; ///< or one that takes the same packets
  std::string title;            ///< as people call it; several where it does not tell which it is
};

Newer newer_of(spec::Robot robot);

/// Which robot of packets v2 is there: the one that is told, or it is asked. Several that take the
/// same packets are as good as one.
tl::expected<Newer, Failure> find_newer(Link& link, std::optional<spec::Robot> told);

/// What a command does with a ball that has been greeted, and with a robot of packets v2.
struct Talks {
  std::function<ExitCode(Link&, uploader::Session&, const uploader::Greeting&)> classic;
  std::function<tl::expected<void, Failure>(Link&, run::TalkV2&, const Newer&)> newer;
};

/// Opens the link that the options name, finds out who answers and has `talks` do its job: the
/// shape of the small commands. A classic ball is greeted as ever; a newer robot shows by its
/// silence. `robot` is what `--robot` says, empty for nothing. Errors are printed; the exit code is
/// left in the context.
void with_robot(Context& context, const PortOptions& options, std::string_view robot,
                const Talks& talks);

/// The same for what only the firmware of a ball does that keeps programs: one that is in its
/// bootloader is refused, and so is a robot of packets v2.
void with_firmware(
    Context& context, const PortOptions& options,
    const std::function<ExitCode(Link&, uploader::Session&, const uploader::Greeting&)>& work);

/// `a Sphero BOLT`, `an R2-D2`.
std::string with_article(std::string_view title);

/// Why a robot of packets v2 gets no program, and what runs one on it.
Failure stores_nothing(const Newer& robot, std::string_view port);

/// A failure, and which robot is there where `robot`, from `--robot`, names another one. It is
/// asked only now, so that nothing is lost where all goes well.
Failure name_robot(Link& link, std::string_view robot, Failure failure);

} // namespace orb::cli
