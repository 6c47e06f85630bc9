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

/// Compiles the text of a program area. It never fails: a line that does not parse becomes a trap
/// with the robot's own error, and so does a statement of a later language.
using Loader = bytecode::Chunk (*)(std::string_view text, spec::BasicVersion language);

using spec::Area;

struct ProgramOptions {
  std::uint32_t lines_per_second = static_cast<std::uint32_t>(
      spec::value_of(spec::Limit::LinesPerSecond)); ///< from 1 to 1 000 000 000
  std::size_t ram_bytes = static_cast<std::size_t>(spec::value_of(spec::Limit::RamBytes));
  Loader loader = nullptr;                                   ///< without it every program is empty
  spec::BasicVersion language = spec::default_basic_version; ///< in a ball that of its firmware
  bool trace_lines = false;                                  ///< the observer is told every line
  spec::Ranges ranges = spec::Ranges::Documented;            ///< Lenient also where the firmware is
  Dispatch dispatch = Dispatch::Threaded;
  Native native = Native::Auto;
  NativePrograms* native_programs = nullptr; ///< machine code that balls share; must outlive them
  Gate* gate = nullptr; ///< is asked before lines and macro commands; must outlive the ball
};

/// orbBasic in a ball: the two areas, the machine, the flags of the program that runs and the
/// numbers for its `input`. Source: API §Append orbBasic Fragment and its neighbours.
class Programs {
public:
  Programs(const ProgramOptions& options, std::uint64_t seed);
  Programs(const Programs&) = default;

  // What clients ask. The area of a program that runs cannot be changed.
  Outcome erase(Area area);
  /// Stores nothing when it does not fit. Text after the final NUL is ignored.
  Outcome append(Area area, ByteView text);
  /// Copies RAM to flash.
  Outcome commit();
  /// A line that is not there is an error of the program.
  Outcome execute(Area area, int line, Instant now);
  void abort() { machine_.abort(); }
  /// A number for a waiting `input`; ignored when none waits.
  void deliver(std::int32_t value, Instant now) { machine_.deliver_input(value, now); }
  void forget_ram() { text_[0].clear(); }

  std::string_view text(Area area) const { return text_[static_cast<std::size_t>(area)]; }
  /// Where the program lies that runs, or ran last.
  Area area() const { return area_; }
  bool running() const { return machine_.running(); }
  bool running(Area area) const { return running() && area_ == area; }
  const Machine& machine() const { return machine_; }

  /// The flags of `basflg`; they last until the program's end.
  void set_flags(std::uint32_t flags) { flags_ = flags; }
  bool has(spec::BasicFlag flag) const { return (flags_ & static_cast<std::uint32_t>(flag)) != 0; }

  // Numbers for the next `input` that waits: a client that answers at once.
  void queue_input(std::int32_t value) { inputs_.push_back(value); }
  bool input_queued() const { return !inputs_.empty(); }
  /// Gives the first of them to a waiting `input`; false where none waits, or there is none.
  bool answer_input(Instant now);
  /// It waits for a number that is not on its way.
  bool waits_in_vain() const;

  Instant next_event() const { return machine_.next_event(); }
  /// Returns the instant that the program has reached.
  Instant run(Instant limit, Host& host);
  void stop(event::End::Reason reason) { machine_.stop(reason); }
  void interrupt() { machine_.interrupt(); }
  /// The gate is asked anew.
  void let_go() { machine_.let_go(); }
  // What a debugger changes.
  void set_variable(std::size_t index, std::int32_t value) { machine_.set_variable(index, value); }
  bool go_to(int line, Instant now) { return machine_.go_to(line, now); }
  /// The stop that has happened since the last call.
  std::optional<Machine::Stop> take_stop() { return machine_.take_stop(); }

private:
  ProgramOptions options_;
  Machine machine_;
  std::array<std::string, 2> text_; ///< by Area
  Area area_ = Area::Ram;
  std::uint32_t flags_ = 0;
  std::deque<std::int32_t> inputs_;
};

} // namespace orb::vm
