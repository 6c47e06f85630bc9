#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/macro.h"
#include "spec/macro.h"
#include "vm/common/observer.h"
#include "vm/macros/macro_host.h"
#include "vm/macros/macro_store.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace orb::vm {

/// How a macro ended.
using MacroEnding = event::MacroEnd::Reason;

/// Result of a request. The API answers 00h for Done, 07h for BadParameter and 08h otherwise.
enum class MacroOutcome : std::uint8_t {
  Done,
  BadParameter,
  NoSuchMacro,
  Busy,      ///< another macro is running
  Inhibited, ///< the macro does not run while a client is connected
  NoRoom     ///< no room, or the id is taken
};

/// The answer to Abort Macro or Get Macro Status.
struct MacroStatus {
  std::uint8_t id = spec::macro_id_none;
  std::uint16_t number = 0; ///< FFFFh in an answer to Abort: the macro is unkillable

  friend bool operator==(MacroStatus, MacroStatus) = default;
};

/// A macro command takes effect on a tick of this length. Source: low-level API §Commands.
inline constexpr Duration macro_tick = 1ms;
/// Most commands without delay per tick, so that a macro that jumps to itself still lets time pass.
/// No source: a choice.
inline constexpr int macro_commands_per_tick = 64;

/// Runs macros: keeps time and order, holds no physics, and asks the host for every effect. The
/// caller supplies the time, which never runs backwards. A macro started at an instant runs its
/// first command when the executive is advanced to that instant, so that the answer leaves before
/// its effects. Large because all commands, those of clients and those in macros, change the one
/// macro that runs.
class MacroExecutive {
public:
  /// `version` is the executive's own: a user's macro that contains a newer command aborts there.
  explicit MacroExecutive(MacroHost& host, std::uint8_t version = spec::macro_executive_newest)
      : host_(&host), version_(version) {}
  /// Copies the state and serves another ball.
  MacroExecutive(const MacroExecutive& other, MacroHost& host);
  MacroExecutive& operator=(const MacroExecutive&) = delete;

  // API commands 50h to 58h.

  /// Run Macro, and orbBasic's macrun.
  MacroOutcome start(int id, Instant now);
  /// Save Temporary Macro. `image` is id (ignored), flags, body. Ends a running temporary or stream
  /// macro.
  MacroOutcome save_temporary(ByteView image, Instant now);
  /// Save Macro: stores a user macro, or appends a chunk of the stream macro, which starts at once.
  MacroOutcome save(ByteView image, Instant now);
  /// Reinit Macro Executive: ends the running macro, erases all macros and resets the parameters to
  /// those at power-on.
  void reinitialize(Instant now);
  /// Abort Macro, and orbBasic's mackill. Returns what was aborted and where. The next chunk begins
  /// a new temporary macro.
  MacroStatus abort(Instant now);
  /// Get Macro Status. When idle the id is 0, and the number is the last macro's.
  MacroStatus status() const { return {id_, number_}; }
  /// Set Macro Parameter. Takes effect with the next command that uses the value.
  MacroOutcome set_parameter(std::uint8_t index, std::uint8_t value1, std::uint8_t value2);
  /// Append Macro Chunk. Only the first chunk carries id and flags.
  MacroOutcome append_chunk(ByteView chunk, Instant now);

  // Time and events.

  /// Runs everything that is due up to `now`.
  void advance_to(Instant now);
  /// The next event; `never` if there is none.
  Instant next_event() const;
  /// Reports a collision: the running macro may branch on it.
  void collide(Instant now);
  /// The ball falls asleep: ends the running macro silently and forgets the index of user macros.
  void fall_asleep(Instant now);

  bool running() const { return id_ != spec::macro_id_none; }
  /// The id of the running macro; 0 if none runs.
  int id() const { return id_; }
  /// The flags in force; 0 if no macro runs.
  std::uint8_t flags() const { return running() ? flags_ : std::uint8_t{0}; }
  bool has(spec::MacroFlag flag) const { return spec::has_flag(flags(), flag); }
  /// A position in the running macro or in one of its callers.
  struct Place {
    int id = 0;
    int command = 0; ///< the command that waits or is next; in a caller, its gosub
  };
  /// The positions, innermost first; empty if no macro runs.
  std::vector<Place> places() const;
  /// `id << 16 | command number`; 0 if no macro runs (orbBasic `macstat`).
  std::uint32_t macstat() const;
  /// A macro that has ended.
  struct Finished {
    event::MacroEnd end;
    std::uint8_t flags = 0; ///< flags in force at its end
  };
  /// Returns a macro that ended since the last call.
  std::optional<Finished> take_finished() { return std::exchange(finished_, std::nullopt); }
  const MacroStore& store() const { return store_; }
  /// Returns true if the last advance_to() stopped before a command because the host held it.
  bool held() const { return held_; }

private:
  MacroExecutive(const MacroExecutive&) = default;

  struct MacroFrame {
    std::uint8_t id = spec::macro_id_none;
    std::uint8_t flags = 0;
    ByteView code;
    std::uint32_t next = 0;
    std::uint16_t number = 0;
  };
  struct Loop {
    std::uint8_t id = spec::macro_id_none; ///< none: no loop
    std::uint32_t start = 0;
    std::uint16_t number = 0;
    std::uint8_t left = 0;
  };
  struct Fade {
    bool active = false;
    Color from;
    Color to;
    Instant begin;
    Duration time{};
  };
  struct Parameters {
    std::uint16_t sd1_ms = 0;
    std::uint16_t sd2_ms = 0;
    std::uint8_t spd1 = 0;
    std::uint8_t spd2 = 0;
    std::uint8_t system_loops = spec::macro_loop_least;
  };

  ByteView image_of(std::uint8_t id) const;
  bool inhibited(std::uint8_t flags) const;
  void enter(std::uint8_t id, std::uint8_t flags, ByteView code);
  void finish(MacroEnding ending);
  void rest(MacroEnding ending);
  void go_to(std::uint8_t id);
  void call(std::uint8_t id);
  void reach_end();
  void begin();
  Instant next_tick() const;
  /// A new tick, or the rest of one that the host held.
  enum class Tick : std::uint8_t { Begins, GoesOn };
  void tick(Tick tick);
  void begin_tick();
  void run_command();
  void perform(const protocol::MacroStep& step);
  void roll(int speed, std::int32_t heading_deg);
  void rotate(std::int32_t angle_deg, std::int32_t time_ms);
  void start_fade(Color to, std::int32_t time_ms);
  void set_color(Color color);
  void step_fade();
  void start_loop(std::uint8_t count);
  void end_loop();
  void wait_ms(std::int32_t time_ms);
  void end_buffer_macro();
  void move_to(Instant now) { now_ = std::max(now_, now); }
  MacroOutcome save_stream(const protocol::MacroHeader& header, ByteView commands);

  MacroHost* host_;
  std::uint8_t version_;
  MacroStore store_;
  Parameters parameters_;
  Instant now_{};
  Instant tick_{}; ///< the last tick; ticks are whole milliseconds apart

  std::uint8_t id_ = spec::macro_id_none;
  std::uint8_t flags_ = 0;
  std::uint16_t number_ = 0; ///< number of the current command, from 1
  ByteView code_;
  std::uint32_t next_ = 0; ///< offset of the next command in code_
  Instant wake_ = never;   ///< when the next command is due; never: a stream waits for a chunk
  bool waits_for_stop_ = false;
  bool collided_ = false;
  std::uint8_t collision_target_ = spec::macro_id_none;
  Loop loop_;
  std::array<MacroFrame, spec::macro_gosub_depth> stack_{};
  std::size_t depth_ = 0;
  Instant rotating_until_{};
  Color color_;
  Fade fade_;
  std::optional<Finished> finished_;
  bool held_ = false;
  int left_ = 0; ///< commands that may still begin in this tick
};

} // namespace orb::vm
