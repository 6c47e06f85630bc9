#pragma once

#include "cli/context/context.h"
#include "cli/many/board.h"
#include "cli/many/roster.h"
#include "spec/ble.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace orb::cli {

/// The default of `--jobs` in words, where it is spec::ble_links_every.
std::string links_at_once();

inline constexpr int all_at_once = 0;

/// What is tried again where a robot could not be worked with.
enum class TryAgain : std::uint8_t {
  Unreached, ///< only where it was not reached: what was sent must not be sent twice
  Lost       ///< also where the link was lost, or the outcome is not known
};

/// What a command prints on stdout for a robot.
enum class Prints : std::uint8_t {
  Lines, ///< as they come, each with the robot's name
  Answer ///< one answer at the end, which is the robot's verdict
};

/// How a command works with several robots.
struct ManyOptions {
  std::string_view command; ///< for JSON
  int jobs = all_at_once;   ///< how many at a time, where the user does not say it
  TryAgain again = TryAgain::Unreached;
  Prints prints = Prints::Lines;
  bool json = false;    ///< one document for all (docs/json.md) in place of the table
  bool one_too = false; ///< also where there is one robot: it has the same document
  /// Asked once before any is reached: what would be wrong with each.
  std::function<tl::expected<void, Failure>()> check;
  /// Why the command is not for this robot: `keeps no programs; …`. Asked before any is reached.
  std::function<std::optional<std::string>(const Member&)> misfit;
};

/// Why `--monitor` does not go with several robots.
Failure listens_to_one();

/// What is done with one robot. `row` is null where it is the only one.
using Work = std::function<void(Context& context, const Member& robot, Row* row)>;

/// Does `work` with each robot that the options name: with a single one as if there were no others,
/// else with some at a time, each on a thread of its own with a context of its own, and tells what
/// became of all in a table or in JSON. Over Bluetooth LE never more than spec::ble_links_most at a
/// time: the others wait, which is said. The failure of one changes nothing for the others; the
/// code in the context is then 5. Ctrl-C ends each as it ends a single one, and begins no more.
void with_robots(Context& context, const RosterOptions& roster, const ManyOptions& options,
                 const Work& work);

/// The options for the link to one robot. One of several has a recording of its own.
PortOptions port_of(PortOptions options, const Member& robot, const Row* row);

/// The name of a robot's own file where several would write one: `wire.txt` is `wire-red.txt`. An
/// empty name stays.
std::string file_of(const std::string& file, const Member& robot);

} // namespace orb::cli
