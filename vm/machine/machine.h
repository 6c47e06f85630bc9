#pragma once

#include "base/time.h"
#include "bytecode/chunk.h"
#include "spec/basic.h"
#include "vm/common/observer.h"
#include "vm/machine/core.h"
#include "vm/machine/host.h"
#include "vm/machine/native/engine.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::vm {

/// How instructions are dispatched. Results are the same; compilers without computed jumps always
/// use Switch.
enum class Dispatch : std::uint8_t { Threaded, Switch };

/// Decides how far programs and macros may run. Implemented by debuggers.
class Gate {
public:
  virtual ~Gate() = default;
  /// Called before a program runs the line at Machine::line(). Returns how many lines may run
  /// before the next call; with 0 the ball returns to its caller.
  virtual std::int64_t lines() = 0;
  /// Called before a macro begins a command. With false the ball returns to its caller.
  virtual bool command() = 0;
};

/// Runs orbBasic: a compiled program, its variables, loops, calls, timers, data and random numbers.
/// A Host provides everything else, and the caller the time. Line k ends at floor(k * 10^9 / lines
/// per second) ns after the program's start, plus waiting times; effects of a line occur at its
/// end. The instructions are in vm/machine/loop.h. Large because everything that others may ask of
/// a running program, or do to it, is a member.
class Machine {
public:
  /// How a program ended.
  struct Termination {
    event::End::Reason reason = event::End::Reason::End;
    int line = 0; ///< of the error
    std::optional<spec::BasicError> error;
    std::uint64_t lines = 0; ///< lines executed
  };

  /// `lines_per_second` is clamped to 1..1 000 000 000. `shared`, if given, supplies machine code
  /// and must outlive the machine.
  Machine(std::uint32_t lines_per_second, std::uint64_t seed,
          Dispatch dispatch = Dispatch::Threaded, Native native = Native::Auto,
          NativePrograms* shared = nullptr);
  /// Copies the machine with all its state. Shared machine code is kept; otherwise the copy
  /// compiles its own.
  Machine(const Machine& other);
  Machine& operator=(const Machine&) = delete;

  /// Starts a program at `line` with cleared state. A missing line is a run-time error: the program
  /// starts and stops at its first run. A chunk that verify() rejects counts as an empty program.
  void start(bytecode::Chunk chunk, int line, Instant now);

  /// Executes the lines that end before `limit`. Returns early after a statement that may change
  /// what the ball does next.
  void run(Instant limit, Host& host);

  /// The end of the next line or wait. `never` if nothing runs or an input without time-out waits.
  Instant next_event() const;

  bool running() const { return running_; }
  /// Returns true while a line waits for a time, for room in the queue or for a number.
  bool waits() const { return running_ && core_.wait != Core::Wait::Nothing; }
  /// Returns true while a line waits for a number. Without a time-out next_event() is `never`.
  bool waits_for_input() const { return running_ && core_.wait == Core::Wait::Input; }
  /// Stops the program with the error User abort.
  void abort();
  /// Stops a running program without an error.
  void stop(event::End::Reason reason);
  /// Completes a waiting `input`. Has no effect otherwise.
  void deliver_input(std::int32_t value, Instant now);
  /// Returns a stop that occurred since the last call.
  std::optional<Termination> take_termination();

  /// Makes the present run() return after the current line.
  void interrupt() { core_.interrupted = true; }

  /// The instant reached.
  Instant now() const { return now_; }
  /// Lines executed since the start of the program.
  std::uint64_t lines() const { return lines_; }
  /// The line that waits, or the next one to run.
  int line() const;
  /// The line that called the host last, for example to print.
  int asking_line() const { return line_of(core_.at); }
  /// Returns A to Y (0 to 24) or an element of Z (from bytecode::first_element); 0 before the first
  /// program.
  std::int32_t variable(std::size_t index) const;
  /// Returns the value of a timer at `now`; 0 for other variables.
  std::int32_t timer(spec::Variable variable, Instant now) const;
  /// The program and its state.
  const Core& core() const { return core_; }
  /// The machine code of the program; null if it is interpreted.
  const NativeCode* machine_code() const { return native_.code(); }
  /// Why the program has no machine code although it was requested; empty otherwise.
  std::string_view only_interpreted() const { return native_.only_interpreted(); }
  /// Lines executed by all programs of this machine.
  std::uint64_t lines_of_all() const { return earlier_lines_ + lines_; }
  /// Consults `gate` before lines from now on; null: no gate.
  void ask(Gate* gate) { gate_ = gate; }
  /// Returns true if the last run() returned because the gate held the program.
  bool held() const { return held_; }
  void let_go() { held_ = false; }

  // Changes made by a debugger.
  void set_variable(std::size_t index, std::int32_t value) { core_.registers[index] = value; }
  /// Continues at another line at `now` and cancels any wait. Returns false if there is no such
  /// line.
  bool go_to(int line, Instant now);

  /// Sets how values out of range are treated.
  void set_ranges(spec::Ranges ranges) { core_.ranges = ranges; }
  /// Reports every line to the host from now on.
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
  std::uint64_t earlier_lines_ = 0; ///< lines of earlier programs
  bool running_ = false;
  bool tracing_ = false;
  Gate* gate_ = nullptr;
  bool held_ = false;
  bool announced_ = false;          ///< tron has printed the number of the next line
  std::optional<int> missing_line_; ///< set if the start line does not exist
  std::optional<Termination> termination_;
};

} // namespace orb::vm
