#pragma once

#include "assembler/assemble.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orb::assembler {

/// A qualification of a total time.
enum class TimingNote : std::uint8_t {
  Exact,
  UntilStopped, ///< a wait_until_stopped makes it a range
  Endless,      ///< the macro never ends by itself
  Leaves,       ///< continues with a macro outside the file
  Calls,        ///< calls a macro outside the file: its time is missing
  SystemLoops,  ///< the API sets how often a loop runs: counted once
  Sleeps,       ///< until it puts the ball to sleep
  Broken,       ///< until bytes that are not a command
  TooLong       ///< too long to follow
};

/// When a command first begins, and how long the next one waits for it, under the system delays
/// then in force (0 at power-on); nothing if it is never reached.
struct CommandTiming {
  std::int64_t begins_ms = 0; ///< the latest
  std::int64_t least_ms = 0;
  std::int64_t most_ms = 0;
  std::uint32_t times = 0; ///< number of executions
};

struct MacroTiming {
  std::vector<std::optional<CommandTiming>> commands; ///< parallel to AssembledMacro::commands
  std::int64_t least_ms = 0;
  std::int64_t most_ms = 0;
  TimingNote note = TimingNote::Exact;
};

/// Computes the run time of a macro, including loops and subroutines of the same file.
MacroTiming time_macro(const Assembly& assembly, std::size_t macro);

/// Prints a time: `3.25 s`, `0 to 5 s (until the ball stops)`, `endless`.
std::string to_string(const MacroTiming& timing);

/// Prints `250 ms` or `2.5 s`.
std::string print_time(std::int64_t ms);

} // namespace orb::assembler
