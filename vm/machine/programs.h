#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "bytecode/chunk.h"
#include "spec/api.h"
#include "spec/basic.h"
#include "spec/limits.h"
#include "vm/body/ask.h"
#include "vm/machine/machine.h"

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace orb::vm {

/// Compiles the text of a program area. Never fails: lines that do not parse, and statements of a
/// later language version, become traps with the robot's own error.
using Loader = bytecode::Chunk (*)(std::string_view text, spec::BasicVersion language);

using spec::Area;

struct ProgramOptions {
  std::uint32_t lines_per_second = static_cast<std::uint32_t>(
      spec::value_of(spec::Limit::LinesPerSecond)); ///< from 1 to 1 000 000 000
  std::size_t ram_bytes = static_cast<std::size_t>(spec::value_of(spec::Limit::RamBytes));
  Loader loader = nullptr;                                   ///< without one every program is empty
  spec::BasicVersion language = spec::default_basic_version; ///< a ball uses that of its firmware
  bool trace_lines = false;                                  ///< report every line to the observer
  spec::Ranges ranges = spec::Ranges::Documented; ///< Lenient is also implied by some firmware
  Dispatch dispatch = Dispatch::Threaded;
  Native native = Native::Auto;
  NativePrograms* native_programs = nullptr; ///< machine code shared by balls; must outlive them
  Gate* gate = nullptr; ///< consulted before lines and macro commands; must outlive the ball
};

/// orbBasic in a ball: the two areas, the machine, the flags of the running program and the numbers
/// for its `input`. Source: API §Append orbBasic Fragment and its neighbours. Large because it
/// passes on what the ball and the debugger ask of the machine.
class Programs {
public:
  Programs(const ProgramOptions& options, std::uint64_t seed);
  Programs(const Programs&) = default;

  // Requests by clients. The area of a running program cannot be changed.
  Outcome erase(Area area);
  /// Refuses text that does not fit. Ignores text after the final NUL.
  Outcome append(Area area, ByteView text);
  /// Copies RAM to flash.
  Outcome commit();
  /// Starts the program at `line`. A missing line is a run-time error of the program.
  Outcome execute(Area area, int line, Instant now);
  void abort() { machine_.abort(); }
  /// A number for a waiting `input`; ignored if none waits.
  void deliver(std::int32_t value, Instant now) { machine_.deliver_input(value, now); }
  void forget_ram() { text_[0].clear(); }

  std::string_view text(Area area) const { return text_[static_cast<std::size_t>(area)]; }
  /// The area of the program that runs or ran last.
  Area area() const { return area_; }
  bool running() const { return machine_.running(); }
  bool running(Area area) const { return running() && area_ == area; }
  const Machine& machine() const { return machine_; }

  /// The flags of `basflg`. They last until the program ends.
  void set_flags(std::uint32_t flags) { flags_ = flags; }
  bool has(spec::BasicFlag flag) const { return (flags_ & static_cast<std::uint32_t>(flag)) != 0; }

  // Numbers for the next waiting `input`, like a client that answers at once.
  void queue_input(std::int32_t value) { inputs_.push_back(value); }
  bool input_queued() const { return !inputs_.empty(); }
  /// Passes the first number to a waiting `input`. Returns false if none waits or no number is
  /// queued.
  bool answer_input(Instant now);
  /// Returns true if it waits for a number and none is queued.
  bool waits_in_vain() const;

  Instant next_event() const { return machine_.next_event(); }
  /// Runs to `limit`. Returns the instant that the program has reached.
  Instant run(Instant limit, Host& host);
  void stop(event::End::Reason reason) { machine_.stop(reason); }
  void interrupt() { machine_.interrupt(); }
  /// Consults the gate again.
  void let_go() { machine_.let_go(); }
  // Changes made by a debugger.
  void set_variable(std::size_t index, std::int32_t value) { machine_.set_variable(index, value); }
  bool go_to(int line, Instant now) { return machine_.go_to(line, now); }
  /// Returns a stop that occurred since the last call.
  std::optional<Machine::Termination> take_termination() { return machine_.take_termination(); }

private:
  ProgramOptions options_;
  Machine machine_;
  std::array<std::string, 2> text_; ///< by Area
  Area area_ = Area::Ram;
  std::uint32_t flags_ = 0;
  std::deque<std::int32_t> inputs_;
};

} // namespace orb::vm
