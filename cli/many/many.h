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

/// The default of `--jobs` in words, if it is spec::ble_links_every.
std::string links_at_once();

inline constexpr int all_at_once = 0;

/// What to retry after a failure.
enum class TryAgain : std::uint8_t {
  Unreached, ///< only an unreachable robot: nothing may be sent twice
  Lost       ///< also a lost link, or an unknown outcome
};

/// What a command prints to stdout for a robot.
enum class Prints : std::uint8_t {
  Lines, ///< lines as they come, with the robot's name
  Answer ///< one answer at the end, which is the verdict
};

/// How a command works with several robots.
struct ManyOptions {
  std::string_view command; ///< for JSON
  int jobs = all_at_once;   ///< default of how many at a time
  TryAgain again = TryAgain::Unreached;
  Prints prints = Prints::Lines;
  bool json = false; ///< prints one document for all (docs/reference/json.md) in place of the table
  bool one_too = false; ///< also for a single robot: same document
  /// Checks once, before connecting, what would be wrong for every robot.
  std::function<tl::expected<void, Failure>()> check;
  /// Why the command does not suit this robot: `keeps no programs; …`. Asked before connecting.
  std::function<std::optional<std::string>(const RosterMember&)> misfit;
};

/// Explains why `--monitor` takes a single robot.
Failure listens_to_one();

/// The work with one robot. `row` is null if it is the only one.
using Work = std::function<void(Context& context, const RosterMember& robot, Row* row)>;

/// Does `work` with each robot that the options name. A single robot is handled as if there were no
/// others. Several are handled a few at a time, each on its own thread with its own context; a
/// table or JSON shows the results. At most spec::ble_links_most robots are connected over
/// Bluetooth LE at a time; a note says that the others wait. A failure does not affect the other
/// robots; the exit code is then 5. Ctrl-C ends each as it would end a single one, and starts no
/// more.
void with_robots(Context& context, const RosterOptions& roster, const ManyOptions& options,
                 const Work& work);

/// The link options for one robot. Each of several robots gets its own recording.
PortOptions port_of(PortOptions options, const RosterMember& robot, const Row* row);

/// The file name for one of several robots: `wire.txt` becomes `wire-red.txt`. An empty name stays
/// empty.
std::string file_of(const std::string& file, const RosterMember& robot);

} // namespace orb::cli
