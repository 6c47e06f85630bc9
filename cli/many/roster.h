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

/// Which robots a command speaks to, as the command line says it.
struct RosterOptions {
  std::vector<std::string> ports; ///< empty for `sim:`, or all robots of `file`
  std::string file;               ///< of more names; empty for none
  int jobs = 0;                   ///< how many at a time; 0: as many as the command is made for
  int tries = 3;                  ///< how often one is tried that cannot be reached
};

/// Adds `--port`, which may stand several times and which the environment may give as ORB_PORT,
/// `--ports`, `--jobs` and `--tries`. `jobs` says what is the default of that.
void add_roster_options(const Command& command, RosterOptions& options, const std::string& jobs);

/// The same where a robot is only one of the bodies that a program can have: without `--port` there
/// is none, whatever the environment says.
void add_robot_roster_options(const Command& command, RosterOptions& options,
                              const std::string& jobs);

/// One of the robots.
struct Member {
  std::string name;                 ///< for people: `red`, or its port
  std::string port;                 ///< for PortOptions: `@red`, or a URL
  std::string place;                ///< where a file names it, `FILE:LINE:COLUMN: `; else empty
  std::optional<spec::Robot> robot; ///< where its name or the file tells
};

struct Roster {
  std::vector<Member> members; ///< in the order in which they are named
  Config config;               ///< in which the names have their meaning
  bool is_one = true;          ///< a single port on the command line: nothing is said of several
};

/// The robots that the options name. Refused at their lines: unknown names, a robot named twice,
/// two names for one robot, an empty group.
tl::expected<Roster, Failure> find_roster(const Context& context, const RosterOptions& options);

} // namespace orb::cli
