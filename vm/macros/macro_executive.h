#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/macro.h"
#include "spec/macro.h"
#include "vm/macros/macro_host.h"
#include "vm/macros/macro_store.h"
#include "vm/observer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace orb::vm {

/// How a macro came to its end.
using MacroEnding = event::MacroEnd::Reason;

/// What came of an ask; the API answers 00h, 07h for a bad parameter, and 08h otherwise.
enum class MacroOutcome : std::uint8_t {
  Done,
  BadParameter,
  NoSuchMacro,
  Busy,      ///< one runs
  Inhibited, ///< it does not run while a client is connected
  NoRoom     ///< or the id is taken
};

/// An answer to Abort Macro or Get Macro Status.
struct MacroStatus {
  std::uint8_t id = spec::macro_id_none;
  std::uint16_t number = 0; ///< FFFFh in an answer to Abort: the macro is unkillable

  friend bool operator==(MacroStatus, MacroStatus) = default;
};

/// A macro command takes effect on a tick of this length. Source: low-level API §Commands.
inline constexpr Duration macro_tick = 1ms;
/// Commands without delay that share a tick; a macro that jumps to itself lets time pass all the
/// same. No source: a choice.
inline constexpr int macro_commands_per_tick = 64;

/// Runs macros. It decides what happens when and holds no physics; the host does what it asks.
/// Time is an argument and never runs backwards. A macro that is started at an instant runs its
/// first command when the executive is advanced to that very instant, so that an answer can leave
/// before what it causes.
class MacroExecutive {
public:
  /// `version` is its own: a user's macro aborts at a command that is newer.
  explicit MacroExecutive(MacroHost& host, std::uint8_t version = spec::macro_executive_newest)
      : host_(&host), version_(version) {}
  /// A copy that serves another ball.
  MacroExecutive(const MacroExecutive& other, MacroHost& host);
  MacroExecutive& operator=(const MacroExecutive&) = delete;

  // API commands 50h to 58h.

  /// Run Macro, orbBasic's macrun.
  MacroOutcome start(int id, Instant now);
  /// Save Temporary Macro: `image` is id (any), flags, body. Ends a temporary or stream macro.
  MacroOutcome save_temporary(ByteView image, Instant now);
  /// Save Macro: a user macro, or a chunk of the stream macro, which starts at once.
  MacroOutcome save(ByteView image, Instant now);
  /// Reinit Macro Executive: nothing runs, nothing is stored, parameters as at power-on.
  void reinitialize(Instant now);
  /// Abort Macro, orbBasic's mackill: what was aborted and where. The next chunk begins a new
  /// temporary macro.
  MacroStatus abort(Instant now);
  /// Get Macro Status: id 0 when idle, with the number left over from the last macro.
  MacroStatus status() const { return {id_, number_}; }
  /// Set Macro Parameter, effective with the next command that uses the value.
  MacroOutcome set_parameter(std::uint8_t index, std::uint8_t value1, std::uint8_t value2);
  /// Append Macro Chunk: only the first chunk carries id and flags.
  MacroOutcome append_chunk(ByteView chunk, Instant now);

  // Time and what happens to the ball.

  /// Does all that is due up to `now`.
  void advance_to(Instant now);
  /// When something happens next by itself; `never` when nothing will.
  Instant next_event() const;
  /// A collision was reported: the running macro may branch on it.
  void collide(Instant now);
  /// The ball falls asleep: whatever runs ends without a word, the index of user macros is lost.
  void fall_asleep(Instant now);

  bool running() const { return id_ != spec::macro_id_none; }
  /// The id of the running macro; 0 when none runs.
  int id() const { return id_; }
  /// The flags in force; 0 when none runs.
  std::uint8_t flags() const { return running() ? flags_ : std::uint8_t{0}; }
  bool has(spec::MacroFlag flag) const { return spec::has_flag(flags(), flag); }
  /// A place in a macro: of the one that runs, or of one that it returns to.
  struct Place {
    int id = 0;
    int command = 0; ///< that waits, or is next; of a caller its gosub
  };
  /// The innermost first; none when no macro runs.
  std::vector<Place> places() const;
  /// `id << 16 | command number`; 0 when none runs (orbBasic `macstat`).
  std::uint32_t macstat() const;
  /// Of a macro that has come to its end.
  struct Finished {
    event::MacroEnd end;
    std::uint8_t flags = 0; ///< that were in force
  };
  /// The one that has finished since the last call.
  std::optional<Finished> take_finished() { return std::exchange(finished_, std::nullopt); }
  /// The colour that macros set last.
  Color color() const { return color_; }
  const MacroStore& store() const { return store_; }
  /// The last advance_to() came back before a command because the host held it.
  bool held() const { return held_; }

private:
  MacroExecutive(const MacroExecutive&) = default;

  struct Frame {
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
  /// Whether a tick begins, or goes on where the host held it.
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
  Instant tick_{}; ///< the last tick; the others lie whole milliseconds from it

  std::uint8_t id_ = spec::macro_id_none;
  std::uint8_t flags_ = 0;
  std::uint16_t number_ = 0; ///< of the command in process, from 1
  ByteView code_;
  std::uint32_t next_ = 0; ///< where the next command stands in code_
  Instant wake_ = never;   ///< when it is its turn; never for a stream that waits for a chunk
  bool waits_for_stop_ = false;
  bool collided_ = false;
  std::uint8_t collision_target_ = spec::macro_id_none;
  Loop loop_;
  std::array<Frame, spec::macro_gosub_depth> stack_{};
  std::size_t depth_ = 0;
  Instant rotating_until_{};
  Color color_;
  Fade fade_;
  std::optional<Finished> finished_;
  bool held_ = false;
  int left_ = 0; ///< commands that this tick may still begin
};

} // namespace orb::vm
