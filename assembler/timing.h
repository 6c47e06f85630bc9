#pragma once

#include "assembler/assemble.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orb::assembler {

/// What stands after a total that is not a plain number of milliseconds.
enum class TimingNote : std::uint8_t {
  Exact,
  UntilStopped, ///< a wait_until_stopped makes it a range
  Endless,      ///< the macro never ends by itself
  Leaves,       ///< it goes on with a macro that is not in the file
  Calls,        ///< it calls a macro that is not in the file: its time is missing
  SystemLoops,  ///< the API sets how often a loop runs: counted once
  Sleeps,       ///< until it puts the ball to sleep
  Broken,       ///< until bytes that are not a command
  TooLong       ///< beyond what is worth following
};

/// When a command begins for the first time and how long the next one waits for it, with the system
/// delays then in force (0 at power-on); nothing where it is never reached.
struct CommandTiming {
  std::int64_t begins_ms = 0; ///< the latest
  std::int64_t least_ms = 0;
  std::int64_t most_ms = 0;
  std::uint32_t times = 0; ///< how often it runs
};

struct MacroTiming {
  std::vector<std::optional<CommandTiming>> commands; ///< beside AssembledMacro::commands
  std::int64_t least_ms = 0;
  std::int64_t most_ms = 0;
  TimingNote note = TimingNote::Exact;
};

/// How long a macro takes, loops and subroutines of the same file included.
MacroTiming time_macro(const Assembly& assembly, std::size_t macro);

/// `3.25 s`, `0 to 5 s (until the ball stops)`, `endless`.
std::string to_string(const MacroTiming& timing);

/// `250 ms` or `2.5 s`.
std::string print_time(std::int64_t ms);

} // namespace orb::assembler
