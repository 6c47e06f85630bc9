#pragma once

#include "base/random.h"
#include "base/time.h"
#include "bytecode/chunk.h"
#include "spec/basic.h"
#include "spec/firmware.h"
#include "spec/limits.h"
#include "vm/machine/host.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace orb::vm {

/// An instruction as the loop runs it: its handler resolved, distances in bytes.
struct Code {
  const void* handler = nullptr;
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  std::uint16_t c = 0;
  std::uint16_t d = 0;
  std::int32_t jump = 0; ///< distance to the target
  std::int32_t next = 0; ///< distance to the following line

  const Code* target() const { return away(jump); }
  const Code* following_line() const { return away(next); }

private:
  const Code* away(std::int32_t distance) const {
    return reinterpret_cast<const Code*>(reinterpret_cast<const char*>(this) + distance);
  }
};

/// A running `for`.
struct Loop {
  std::uint32_t body = 0; ///< index of its first line in the code
  std::int32_t end = 0;
  std::int32_t step = 0;
  std::uint32_t variable = 0; ///< a register, or bytecode::element_by_index
};

/// Open loops and calls, shared by the loop and machine code.
struct Frames {
  static constexpr auto for_depth = static_cast<std::size_t>(spec::value_of(spec::Limit::ForDepth));
  static constexpr auto gosub_depth =
      static_cast<std::size_t>(spec::value_of(spec::Limit::GosubDepth));
  /// Variable of the sentinel below all loops: no `next` matches it.
  static constexpr std::uint32_t no_variable = 0xFFFE;

  std::array<Loop, for_depth + 1> loops;          ///< the first is the sentinel
  Loop* loop = nullptr;                           ///< the innermost
  std::array<std::uint32_t, gosub_depth> calls{}; ///< where each `return` continues in the code
  std::uint32_t call_depth = 0;
};

/// What a slow operation tells the loop to do.
enum class Then : std::uint8_t {
  Next,  ///< continue
  Fault, ///< stop the program with `error`
  Leave  ///< end the run after this line, so that the ball can look at the world first
};

/// How a print statement ends.
enum class PrintEnd : std::uint8_t { Line, Open };

/// Why the loop returned.
enum class Exit : std::uint8_t { Budget, Leave, Fault, Ended };

/// State shared by the loop and the slow operations. The loop keeps `pc`, `loop` and `budget` in
/// processor registers and stores them here before it returns or calls. Large because the loop,
/// machine code and the slow operations reach all state of a program through this one object.
struct Core {
  // The program.
  bytecode::Chunk chunk;
  std::vector<Code> code; ///< parallel to chunk.code
  std::vector<std::int32_t> registers;
  /// By register, for constants above 2: used by DivideBy and RemainderBy.
  std::vector<std::int64_t> reciprocals;

  // The position.
  const Code* pc = nullptr; ///< the next instruction
  const Code* at = nullptr; ///< the instruction that failed or called a slow operation
  const Code* start = nullptr;
  Frames frames;
  spec::BasicError error{};

  // The clock. Line k ends at base + floor(k * 10^9 / lines_per_second).
  std::int64_t lines_per_second = 1;
  Instant base{};
  std::int64_t done = 0;    ///< lines since base, before this run
  std::int64_t allowed = 0; ///< lines that this run may execute
  std::int64_t budget = 0;  ///< rest of `allowed`

  // State of statements.
  struct Timer {
    Instant since{};
    std::int32_t from = 0; ///< counts down from here; 0: counts up
  };
  std::array<Timer, 3> timers;
  std::array<std::int32_t, static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues))>
      data{};
  std::size_t data_count = 0;
  std::size_t data_next = 0;
  std::string text; ///< collected by `print`
  bool tron = false;
  Random seeds{0};  ///< source of seeds for `random`
  Random random{0}; ///< generator for `rnd`

  // What the current line waits for.
  enum class Wait : std::uint8_t { Nothing, Time, Queue, Input };
  Wait wait = Wait::Nothing;
  Instant until = never;     ///< for Time and Queue, and for Input with a time-out
  std::string pending;       ///< text that did not fit the queue
  std::uint16_t entry = 0;   ///< variable of `input`
  std::int32_t fallback = 0; ///< value of `input` after the time-out

  spec::Ranges ranges = spec::Ranges::Documented;
  Host* host = nullptr;
  bool interrupted = false; ///< return to the ball after this line

  std::uint32_t index_of(const Code* place) const {
    return static_cast<std::uint32_t>(place - code.data());
  }
  Instant time_of(std::int64_t line) const {
    return base + Duration{line * Duration{std::chrono::seconds{1}}.count() / lines_per_second};
  }
  /// The end of the current line.
  Instant line_end() const { return time_of(done + allowed - budget); }

  Then fail(spec::BasicError what) {
    error = what;
    return Then::Fault;
  }

  // The slow operations, each named after its instruction.
  Then read_system(const Code& code);
  Then write_system(const Code& code);
  Then square_root(const Code& code);
  Then random_number(const Code& code);
  void print_number(std::int32_t value);
  Then print(PrintEnd end);
  Then delay(std::int32_t milliseconds);
  Then input(const Code& code);
  Then input_timed(const Code& code);
  Then set_data(const Code& code);
  Then read_data(const Code& code);
  Then perform(const Code& code);
  std::int32_t timer(spec::Variable variable, Instant now) const;
  void reseed();
  void clear();
  Then trace();
  Then reset();
  /// Assigns a number to the variable of the waiting `input`.
  Then enter(std::int32_t value);
};

/// Returns true if the variable is a timer.
bool is_timer(spec::Variable variable);

/// One implementation of the loop: the handlers for Code::handler, and the loop itself.
struct Engine {
  /// Two per bytecode::Op: one continues the line, the other ends it.
  const void* const* handlers;
  Exit (*run)(Core&);
};

/// Jumps from each instruction directly to the next. Falls back to the switch if the compiler lacks
/// computed jumps.
Engine threaded_engine();
/// Dispatches by one switch.
Engine switch_engine();

} // namespace orb::vm
