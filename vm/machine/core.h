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

/// An instruction as the loop runs it: the handler is known, distances are in bytes.
struct Code {
  const void* handler = nullptr;
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  std::uint16_t c = 0;
  std::uint16_t d = 0;
  std::int32_t jump = 0; ///< from here to the target
  std::int32_t next = 0; ///< from here to the line that follows

  const Code* target() const { return away(jump); }
  const Code* following_line() const { return away(next); }

private:
  const Code* away(std::int32_t distance) const {
    return reinterpret_cast<const Code*>(reinterpret_cast<const char*>(this) + distance);
  }
};

/// A running `for`.
struct Loop {
  std::uint32_t body = 0; ///< where its first line begins in the code
  std::int32_t end = 0;
  std::int32_t step = 0;
  std::uint32_t variable = 0; ///< a register, or bytecode::element_by_index
};

/// The loops and calls that are open: the loop and machine code take turns at them.
struct Frames {
  static constexpr auto for_depth = static_cast<std::size_t>(spec::value_of(spec::Limit::ForDepth));
  static constexpr auto gosub_depth =
      static_cast<std::size_t>(spec::value_of(spec::Limit::GosubDepth));
  /// The variable of the loop below all loops: no `next` matches it.
  static constexpr std::uint32_t no_variable = 0xFFFE;

  std::array<Loop, for_depth + 1> loops;          ///< the first is below all loops
  Loop* loop = nullptr;                           ///< the innermost
  std::array<std::uint32_t, gosub_depth> calls{}; ///< where `return` goes on in the code
  std::uint32_t call_depth = 0;
};

/// What an operation that the loop does not do by itself says about going on.
enum class Then : std::uint8_t {
  Next,  ///< go on
  Fault, ///< the program stops with `error`
  Leave  ///< the line has ended; let the ball look at the world before the next one
};

/// How a print statement ends.
enum class PrintEnd : std::uint8_t { Line, Open };

/// Why the loop came back.
enum class Exit : std::uint8_t { Budget, Leave, Fault, Ended };

/// What the loop and the slow operations share. The loop keeps `pc`, `loop` and `budget` in
/// registers of the processor and writes them here when it lets go.
struct Core {
  // The program.
  bytecode::Chunk chunk;
  std::vector<Code> code; ///< one for one with the chunk's
  std::vector<std::int32_t> registers;
  /// By register, of constants above 2: for DivideBy and RemainderBy.
  std::vector<std::int64_t> reciprocals;

  // Where it is.
  const Code* pc = nullptr; ///< what runs next
  const Code* at = nullptr; ///< what called a slow operation, or failed
  const Code* start = nullptr;
  Frames frames;
  spec::BasicError error{};

  // The clock. Line k ends at base + floor(k * 10^9 / lines_per_second).
  std::int64_t lines_per_second = 1;
  Instant base{};
  std::int64_t done = 0;    ///< lines since base, before this run
  std::int64_t allowed = 0; ///< lines that this run may execute
  std::int64_t budget = 0;  ///< what is left of them

  // What statements own.
  struct Timer {
    Instant since{};
    std::int32_t from = 0; ///< counts down from here; 0 counts up
  };
  std::array<Timer, 3> timers;
  std::array<std::int32_t, static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues))>
      data{};
  std::size_t data_count = 0;
  std::size_t data_next = 0;
  std::string text; ///< what `print` has put together
  bool tron = false;
  Random seeds{0};  ///< the stream that `random` draws from
  Random random{0}; ///< the generator that `rnd` draws from

  // What a line waits for.
  enum class Wait : std::uint8_t { Nothing, Time, Queue, Input };
  Wait wait = Wait::Nothing;
  Instant until = never;     ///< of Time and Queue; of Input where it has a time-out
  std::string pending;       ///< the text that did not fit the queue
  std::uint16_t entry = 0;   ///< the variable of `input`
  std::int32_t fallback = 0; ///< what it takes when nothing comes

  spec::Ranges ranges = spec::Ranges::Documented;
  Host* host = nullptr;
  bool interrupted = false; ///< somebody wants the ball back after this line

  std::uint32_t index_of(const Code* place) const {
    return static_cast<std::uint32_t>(place - code.data());
  }
  Instant time_of(std::int64_t line) const {
    return base + Duration{line * Duration{std::chrono::seconds{1}}.count() / lines_per_second};
  }
  /// The end of the line that is being executed.
  Instant line_end() const { return time_of(done + allowed - budget); }

  Then fail(spec::BasicError what) {
    error = what;
    return Then::Fault;
  }

  // The slow operations: each belongs to the instruction of its name.
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
  /// Sets what `input` waits for.
  Then enter(std::int32_t value);
};

/// Whether a variable is one of the timers.
bool is_timer(spec::Variable variable);

/// A way to run code: what to put into Code::handler for each operation, and the loop itself.
struct Engine {
  /// By bytecode::Op: a pair for what goes on with the line and for what ends it.
  const void* const* handlers;
  Exit (*run)(Core&);
};

/// The loop with a jump from each instruction to the next; where the compiler has no such jumps it
/// is the switch.
Engine threaded_engine();
/// The loop as one switch.
Engine switch_engine();

} // namespace orb::vm
