#pragma once

#include "base/time.h"
#include "bytecode/chunk.h"
#include "spec/basic.h"
#include "vm/machine/core.h"
#include "vm/machine/host.h"
#include "vm/native/engine.h"
#include "vm/observer.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::vm {

/// How instructions are dispatched. Both do the same; Switch is what compilers without computed
/// jumps take.
enum class Dispatch : std::uint8_t { Threaded, Switch };

/// Decides how far programs and macros may go: a debugger.
class Gate {
public:
  virtual ~Gate() = default;
  /// A program is about to run a line, at Machine::line(). How many lines may run before the gate
  /// is asked again; with 0 the ball comes back to whoever lets it live.
  virtual std::int64_t lines() = 0;
  /// A macro is about to begin a command; with false the ball comes back.
  virtual bool command() = 0;
};

/// Runs orbBasic: a compiled program, its variables, loops, calls, timers, data and random numbers.
/// It asks a Host for everything else and is handed the time. Line k of a program ends at
/// floor(k * 10^9 / lines per second) ns after its start, plus what it waited; what a line does
/// happens when it ends. The instructions themselves run in vm/machine/loop.h.
class Machine {
public:
  /// Why and where a program stopped.
  struct Stop {
    event::End::Reason reason = event::End::Reason::End;
    int line = 0; ///< of the error
    std::optional<spec::BasicError> error;
    std::uint64_t lines = 0; ///< that were executed
  };

  /// `lines_per_second` is 1 to 1 000 000 000; values outside are moved to the nearest. Machine
  /// code is taken from `shared`, where that is given; it must outlive the machine.
  Machine(std::uint32_t lines_per_second, std::uint64_t seed,
          Dispatch dispatch = Dispatch::Threaded, Native native = Native::Auto,
          NativePrograms* shared = nullptr);
  /// A copy that has come just as far. Machine code comes along where it is shared; else the copy
  /// makes its own.
  Machine(const Machine& other);
  Machine& operator=(const Machine&) = delete;

  /// Starts a program at `line` with a clean slate. A line that does not exist is an error of the
  /// program: it is running, and stops as soon as it is run. A chunk that verify() refuses counts
  /// as an empty program.
  void start(bytecode::Chunk chunk, int line, Instant now);

  /// Executes the lines that end before `limit`, or fewer: it returns early after a statement that
  /// may have changed what the ball does next.
  void run(Instant limit, Host& host);

  /// When it has something to do: the end of the next line, or of a wait. `never` when nothing runs
  /// or an input without time-out waits.
  Instant next_event() const;

  bool running() const { return running_; }
  /// Whether its line waits: for a time, for room in the queue, for a number.
  bool waits() const { return running_ && core_.wait != Core::Wait::Nothing; }
  /// Whether it waits for a number; without a time-out next_event() is `never`.
  bool waits_for_input() const { return running_ && core_.wait == Core::Wait::Input; }
  /// Ends the program from outside: a stop with the error User abort.
  void abort();
  /// Ends the program, where one runs, without an error.
  void stop(event::End::Reason reason);
  /// Completes a waiting `input`; ignored otherwise.
  void deliver_input(std::int32_t value, Instant now);
  /// The stop that has happened since the last call.
  std::optional<Stop> take_stop();

  /// While it runs: it comes back after the present line.
  void interrupt() { core_.interrupted = true; }

  /// The instant that the machine has reached.
  Instant now() const { return now_; }
  /// Lines executed since the start of the program.
  std::uint64_t lines() const { return lines_; }
  /// The number of the line that waits, or of the one that runs next.
  int line() const;
  /// The number of the line that asked the host for something last, as `print` does.
  int asking_line() const { return line_of(core_.at); }
  /// The value of A to Y (0 to 24) or of an element of Z (from bytecode::first_element); 0 before
  /// the first program.
  std::int32_t variable(std::size_t index) const;
  /// The value of a timer at `now`; 0 for every other variable.
  std::int32_t timer(spec::Variable variable, Instant now) const;
  /// The program and all that it has come to.
  const Core& core() const { return core_; }
  /// The machine code of the program; null where it is interpreted.
  const NativeCode* machine_code() const { return native_.code(); }
  /// Why there is none although it was wanted; empty otherwise.
  std::string_view only_interpreted() const { return native_.only_interpreted(); }
  /// Lines executed since there is this machine.
  std::uint64_t lines_of_all() const { return earlier_lines_ + lines_; }
  /// From now on `gate` is asked before lines; null: nobody.
  void ask(Gate* gate) { gate_ = gate; }
  /// The last run() came back because the gate let no line pass.
  bool held() const { return held_; }
  void let_go() { held_ = false; }

  // What a debugger changes.
  void set_variable(std::size_t index, std::int32_t value) { core_.registers[index] = value; }
  /// Goes on at another line at `now`, whatever it waited for; false where there is no such line.
  bool go_to(int line, Instant now);

  /// What values out of range do from now on.
  void set_ranges(spec::Ranges ranges) { core_.ranges = ranges; }
  /// From now on the host is told every line.
  void trace_lines() { tracing_ = true; }

private:
  void link(bytecode::Chunk given);
  bool continue_wait(Instant limit, Host& host);
  void resume(Instant at);
  bool announce(Host& host);
  std::int64_t lines_before(Instant limit) const;
  int line_of(const Code* code) const;
  void finish(event::End::Reason reason);
  void finish(spec::BasicError error, int line);

  Engine engine_;
  Core core_;
  NativeEngine native_;
  Instant now_{};
  std::uint64_t lines_ = 0;
  std::uint64_t earlier_lines_ = 0; ///< of earlier programs
  bool running_ = false;
  bool tracing_ = false;
  Gate* gate_ = nullptr;
  bool held_ = false;
  bool announced_ = false;          ///< tron has printed the number of the next line
  std::optional<int> missing_line_; ///< the start line does not exist
  std::optional<Stop> stop_;
};

} // namespace orb::vm
