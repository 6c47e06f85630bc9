#pragma once

#include "cli/context/context.h"
#include "cli/robot/link.h"
#include "run/held_robot.h"
#include "run/tether/run_tethered.h"

#include <memory>
#include <string>
#include <tl/expected.hpp>

namespace orb::cli {

/// A robot at the other end of a link that programs drive.
struct DrivenRobot {
  Link link;
  run::TetherOptions tether;   ///< what it is, and how it is reached again
  std::unique_ptr<Link> again; ///< the link that came after the first was lost
};

/// Opens the link that `port` names. `name` says which robot answers there; where it is empty, the
/// name in the port tells, or the robot itself is asked. A link that is lost is opened again as
/// soon as that works, within the time that the robot needs to stop by itself and that for one
/// answer.
tl::expected<std::unique_ptr<DrivenRobot>, Failure>
connect_robot(const Context& context, const PortOptions& port, const std::string& name);

/// The same, readied for a debugger.
tl::expected<std::shared_ptr<run::HeldRobot>, Failure>
hold_robot(const Context& context, const PortOptions& port, const std::string& name);

} // namespace orb::cli
