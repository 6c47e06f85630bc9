#pragma once

#include "base/time.h"
#include "bytecode/chunk.h"
#include "spec/basic.h"
#include "vm/host.h"
#include "vm/observer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orb::vm {

/// Runs orbBasic: a compiled program, its variables, loops, calls, timers, data and random numbers.
/// It asks a Host for everything else and is handed the time. Line k of a program ends at
/// floor(k * 10^9 / lines per second) ns after its start, plus what it waited; what a line does
/// happens when it ends.
class Machine {
public:
  /// Why and where a program stopped.
  struct Stop {
    event::End::Reason reason = event::End::Reason::End;
    int line = 0; ///< of the error
    std::optional<spec::BasicError> error;
    std::uint64_t lines = 0; ///< that were executed
  };

  Machine(std::uint32_t lines_per_second, std::uint64_t seed);

  /// Starts a program at `line` with a clean slate. A line that does not exist is an error of the
  /// program: it is running, and stops as soon as it is run.
  void start(bytecode::Chunk chunk, int line, Instant now);

  /// Executes the lines that end before `limit`, or fewer: it returns early after a statement that
  /// may have changed what the ball does next.
  void run(Instant limit, Host& host);

  /// When it has something to do: the end of the next line, or of a wait. `never` when nothing runs
  /// or an input without time-out waits.
  Instant next_event() const;

  bool running() const { return running_; }
  bool waits_for_input() const { return false; }
  /// Ends the program from outside: a stop with the error User abort.
  void abort(Instant now);
  /// Ends the program, where one runs, without an error.
  void stop(event::End::Reason reason);
  /// Completes a waiting `input`; ignored otherwise.
  void deliver_input(std::int32_t value, Instant now);
  /// The stop that has happened since the last call.
  std::optional<Stop> take_stop();

  /// The instant that the machine has reached.
  Instant now() const { return now_; }
  std::uint64_t lines() const { return lines_; }
  /// The value of A to Y (0 to 24) or of an element of Z (from bytecode::first_element).
  std::int32_t variable(std::size_t index) const;
  void trace_lines() { tracing_ = true; }

private:
  Instant now_{};
  std::uint64_t lines_ = 0;
  bool running_ = false;
  bool tracing_ = false;
  std::optional<Stop> stop_;
};

} // namespace orb::vm
