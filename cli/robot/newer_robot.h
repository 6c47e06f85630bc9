#pragma once

#include "cli/robot/link.h"
#include "run/tether/talk_v2.h"

#include <functional>

namespace orb::cli {

class Command;

/// Adds `--robot`, for links whose name does not tell which robot of packets v2 answers there.
void add_newer_robot_option(const Command& command, std::string& robot);

/// The robot of packets v2 that the options name, by `--robot` or in the port; null for another.
const spec::RobotInfo* newer_robot(const Context& context, const PortOptions& options,
                                   std::string_view robot);

/// Opens the link to it and lets `work` do its job: the shape of the small commands. Errors are
/// printed; the exit code is left in the context.
void with_newer_robot(Context& context, const PortOptions& options, const spec::RobotInfo& robot,
                      const std::function<tl::expected<void, Failure>(run::TalkV2&)>& work);

} // namespace orb::cli
