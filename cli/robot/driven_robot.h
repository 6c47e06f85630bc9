#pragma once

#include "cli/context/context.h"
#include "cli/robot/link.h"
#include "run/held_robot.h"
#include "run/tether/run_tethered.h"

#include <memory>
#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// A robot that programs drive over a link.
struct DrivenRobot {
  Link link;
  run::TetherOptions tether;   ///< identifies the robot, and reconnects
  std::unique_ptr<Link> again; ///< the replacement of a lost link
};

/// Opens the link that `port` names. `name` says which robot it is; if empty, the port's name or
/// the robot itself tells. Reopens a lost link as soon as possible, within the time after which the
/// robot stops by itself plus the time of one answer.
tl::expected<std::unique_ptr<DrivenRobot>, Failure>
connect_robot(const Context& context, const PortOptions& port, const std::string& name);

/// The same, prepared for a debugger.
tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
hold_robot(const Context& context, const PortOptions& port, const std::string& name);

} // namespace orb::cli
