#pragma once

#include "cli/context/context.h"
#include "cli/robot/link.h"

#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

class Command;

/// The robots that a command works with, as given on the command line.
struct RosterOptions {
  std::vector<std::string> ports; ///< empty for `sim:`, or for all robots of `file`
  std::string file;               ///< file with more names; empty for none
  int jobs = 0;                   ///< how many at a time; 0: the command's default
  int tries = 3;                  ///< attempts to reach a robot
};

/// Adds `--port`, which is repeatable and also comes from ORB_PORT, `--ports`, `--jobs` and
/// `--tries`. `jobs` describes the default of `--jobs`.
void add_roster_options(const Command& command, RosterOptions& options, const std::string& jobs);

/// The same for commands that can do without a robot: only `--port` names one, the environment does
/// not.
void add_robot_roster_options(const Command& command, RosterOptions& options,
                              const std::string& jobs);

/// One of the robots.
struct RosterMember {
  std::string name;                 ///< for people: `red`, or its port
  std::string port;                 ///< for PortOptions: `@red`, or a URL
  std::string place;                ///< its place in a file, `FILE:LINE:COLUMN: `; else empty
  std::optional<spec::Robot> robot; ///< if the name or the file tells
};

struct Roster {
  std::vector<RosterMember> members; ///< in the order given
  Config config;                     ///< defines the names
  bool is_one = true; ///< a single port on the command line: messages do not mention several
};

/// Finds the robots that the options name. Fails, with the line, for unknown names, robots named
/// twice, two names for one robot, and empty groups.
tl::expected<Roster, Failure> find_roster(const Context& context, const RosterOptions& options);

} // namespace orb::cli
