#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "bytecode/chunk.h"
#include "protocol/packet.h"
#include "spec/basic.h"
#include "spec/firmware.h"
#include "spec/limits.h"
#include "vm/body.h"
#include "vm/dispatcher.h"
#include "vm/host.h"
#include "vm/machine.h"
#include "vm/macro_executive.h"
#include "vm/macro_host.h"
#include "vm/observer.h"
#include "vm/output.h"
#include "vm/settings.h"
#include "vm/stimulus.h"
#include "vm/streamer.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::vm {

/// Compiles the text of a program area. It never fails: a line that does not parse becomes a trap
/// with the robot's own error.
using Loader = bytecode::Chunk (*)(std::string_view text);

/// Who asks. Every ask that can be contended names its actor.
enum class Actor : std::uint8_t { Client, Basic, Macro };

/// Where programs are stored.
enum class Area : std::uint8_t { Ram = 0, Flash = 1 };

/// What came of an ask of a client: a refusal is answered with "cannot be done now".
enum class Outcome : std::uint8_t { Done, Refused };

struct BallOptions {
  std::uint64_t seed = 1;
  std::uint32_t lines_per_second = static_cast<std::uint32_t>(
      spec::value_of(spec::Limit::LinesPerSecond)); ///< from 1 to 1 000 000 000
  spec::Firmware firmware = spec::default_firmware;
  std::size_t ram_bytes = static_cast<std::size_t>(spec::value_of(spec::Limit::RamBytes));
  Wire wire = Wire::Paced;
  Loader loader = nullptr;      ///< without it every program is empty
  Observer* observer = nullptr; ///< must outlive the ball
  bool trace_lines = false;     ///< the observer is told every line
  Dispatch dispatch = Dispatch::Threaded;
  Native native = Native::Auto;
  NativePrograms* native_programs =
      nullptr; ///< to share machine code with other balls; outlives it
};

/// A ball. A discrete-event simulation that is handed the time: it jumps from one thing that can
/// happen to the next, and a ball at rest costs nothing to advance. At one instant things happen in
/// this order: control system, stimuli, dispatcher, macro, streaming, orbBasic.
///
/// It owns the parts and stands between them: who drives and whose colour shows is decided here and
/// nowhere else. Executives decide and hold no physics; the body has physics and knows no program.
class Ball final : private Host, private MacroHost {
public:
  explicit Ball(const BallOptions& options);
  Ball(const Ball&) = delete;
  Ball& operator=(const Ball&) = delete;

  // The link.
  /// A client connects; a sleeping ball wakes up.
  void connect();
  void disconnect();
  bool connected() const override { return connected_; }
  /// Bytes from the client, at now().
  void receive(ByteView bytes);
  /// What has left the ball until now(): whole packets, at 11 520 bytes a second.
  Bytes take_output();
  /// The same, a packet at a time; nothing when none has left.
  std::optional<Bytes> take_packet();

  // Time.
  Instant now() const { return now_; }
  /// Lets everything happen that is due up to and including `target`.
  void advance_to(Instant target);
  /// The same, but comes back as soon as the ball is quiet(), or its observer calls interrupt().
  void advance_until_quiet(Instant target);
  /// Nothing runs or will run by itself: no program, no macro, no wake-up, and all output has left.
  /// A program that waits for a number that nobody will bring is quiet, too.
  bool quiet() const;
  /// The same, but output may still be leaving.
  bool idle() const;
  /// Since when it is idle, as far as advance_until_quiet() has seen.
  std::optional<Instant> idle_since() const { return idle_since_; }
  /// Lets advance_until_quiet() come back after the present event.
  void interrupt() { interrupted_ = true; }
  /// When something happens next by itself, output that leaves included; `never` at rest.
  Instant next_event() const;

  /// Lets a stimulus happen now.
  void apply(const Stimulus& stimulus);
  /// Lets the events of a script happen, their times counted from now().
  void schedule(std::span<const TimedStimulus> script);

  // Actions: what the dispatcher asks for clients, and everybody else for themselves. Asks to drive
  // that an exclusive holder excludes are ignored.
  void roll(Actor actor, const Roll& roll);
  void rotate(Actor actor, int angle_deg, Duration time);
  void set_motors(Actor actor, Motor left, Motor right);
  void set_heading(Actor actor, int heading_deg);
  void set_stabilization(Actor actor, Stabilization mode);
  void set_rotation_rate(Actor actor, double deg_per_s);
  void stop(Actor actor);
  /// A client's colour is the application colour; it is also what cmdrgb tells programs.
  void set_led(Actor actor, Color color);
  void set_back_led(Actor actor, int level);
  /// Falls asleep as soon as whoever asked has returned.
  void sleep(const Sleep& sleep);

  // orbBasic, for clients (Source: API §Append orbBasic Fragment and its neighbours).
  Outcome erase_basic(Area area);
  /// Stores nothing when it does not fit. Text after the final NUL is ignored.
  Outcome append_basic(Area area, ByteView text);
  Outcome execute_basic(Area area, int line);
  void abort_basic();
  Outcome commit_basic();
  /// A number for a waiting `input`; ignored when none waits.
  void deliver_input(std::int32_t value);
  /// A number for the next `input` that waits: a client that answers at once.
  void queue_input(std::int32_t value) { inputs_.push_back(value); }
  bool input_queued() const { return !inputs_.empty(); }
  std::string_view basic_text(Area area) const;
  /// Where the program lies that runs, or ran last.
  Area basic_area() const { return running_area_; }
  bool basic_running() const { return machine_.running(); }
  const Machine& machine() const { return machine_; }

  /// Starts a stored macro.
  MacroOutcome run_macro(int id);

  // Output.
  void send(const protocol::Response& response);
  /// Async messages reach a connected client only; under congestion those that are not vital are
  /// dropped (docs/ball.md).
  void send(const protocol::Async& async);
  /// Async messages wait from here to release_messages(), so that an answer can go before them.
  void hold_messages() { holding_ = true; }
  void release_messages();
  /// Packets handed to the link, and messages dropped under congestion.
  std::uint32_t sent() const { return sent_; }
  std::uint32_t dropped() const { return dropped_; }
  void clear_sent() { sent_ = dropped_ = 0; }

  // Parts, for the dispatcher and for whoever watches.
  const Body& body() const { return body_; }
  Body& body() { return body_; }
  MacroExecutive& macros() { return macros_; }
  /// Call it after any ask of a client that may have started or stopped a macro.
  void macros_changed();
  const MacroExecutive& macros() const { return macros_; }
  Streamer& streamer() { return streamer_; }
  Dispatcher& dispatcher() { return dispatcher_; }
  Settings& settings() { return settings_; }
  const Settings& settings() const { return settings_; }
  /// Call it after changing settings(): flags and colours take effect.
  void settings_changed();
  /// Call it after any ask of a client that resets the inactivity timer.
  void client_was_active();
  bool asleep() const { return asleep_; }
  /// Whether it will fall asleep as soon as whoever asked has returned.
  bool falls_asleep() const { return falls_asleep_.has_value(); }
  /// Stops programs, macros, streams and motors, as for the bootloader.
  void shut_down();
  /// When the sleeping ball wakes up by itself.
  std::optional<Instant> wake_up() const;
  Color led() const { return body_.led(); }
  /// 1 charging, 2 OK, 3 low, 4 critical (Source: API §Get Power State).
  int battery_state() const;
  std::uint64_t seed() const { return options_.seed; }
  spec::Firmware firmware() const { return options_.firmware; }
  /// The millisecond counter that stamps messages (API §Assign Time Value); 0 at power-on.
  std::uint32_t clock_ms() const;
  void set_clock_ms(std::uint32_t value);

private:
  // Host: what a program asks.
  std::int32_t read(spec::Variable variable, Instant now) override;
  std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                        Instant now) override;
  std::optional<spec::BasicError>
  perform(spec::Statement statement, std::span<const std::int32_t> arguments, Instant now) override;
  std::optional<Instant> print(std::string_view text, Instant now) override;
  void line_ended(int line, Instant now) override;

  // MacroHost: what a macro asks.
  void roll(const Roll& roll) override;
  void rotate(int angle_deg, Duration time) override;
  void set_motors(Motor left, Motor right) override;
  void set_heading(int heading_deg) override;
  void set_stabilization(Stabilization mode) override;
  void set_rotation_rate(double deg_per_s) override;
  void set_led(Color color) override;
  void set_back_led(int level) override;
  void configure_collisions(const CollisionSettings& settings) override;
  void set_speed(int speed) override;
  void stop_motors() override;
  void emit_marker(int marker, int macro, int command) override;
  void trace_command(int macro, int command) override;
  void sleep_ms(int time_ms) override;
  bool stopped() const override { return body_.stopped(); }

  void trace(const Event& event);
  bool may_drive(Actor actor) const { return !exclusive_ || *exclusive_ == actor; }
  void update_exclusive();
  void moved();
  void show_led();
  void show_back_led(int level);
  Color led_now() const;
  bool keeps_awake() const;
  void report_error(int line, spec::BasicError error);
  void finish_basic();
  void fall_asleep();
  void wake();
  void detect_collision(const Impact& impact);
  void check_battery();
  void watch_motion();
  enum class Until : std::uint8_t { Target, Quiet };
  void advance(Instant target, Until until);
  bool answer_input();
  Instant next_housekeeping() const;
  Instant next_simulation_event() const;
  void run_events(Instant bound);
  void keep_house();
  std::string& area_text(Area area) { return areas_[static_cast<std::size_t>(area)]; }

  BallOptions options_;
  Instant now_{};
  Body body_;
  Machine machine_;
  MacroExecutive macros_;
  Dispatcher dispatcher_;
  Streamer streamer_;
  Output output_{options_.wire};
  Settings settings_;
  std::array<std::string, 2> areas_; ///< by Area
  Area running_area_ = Area::Ram;
  std::vector<TimedStimulus> script_; ///< `at` counts from the ball's power-on; latest first

  std::deque<std::int32_t> inputs_;
  bool interrupted_ = false;
  std::optional<Instant> idle_since_;
  bool holding_ = false;
  std::vector<protocol::Async> held_;
  std::uint32_t sent_ = 0;
  std::uint32_t dropped_ = 0;
  bool connected_ = false;
  bool asleep_ = false;
  std::optional<Sleep> falls_asleep_;
  Sleep wake_up_;
  Instant wake_at_ = never;

  std::optional<Actor> exclusive_;
  std::uint32_t basic_flags_ = 0;
  bool macro_ran_ = false;
  std::optional<Color> application_led_;
  std::optional<Color> basic_led_;
  std::optional<Color> macro_led_;
  int back_led_ = 0;

  // What clients sent, for programs: cmdroll, spdval, hdgval, cmdrgb, redval, grnval, bluval.
  bool new_roll_ = false;
  Roll client_roll_;
  bool new_color_ = false;
  Color client_color_;
  bool double_shake_ = false;

  Instant motion_deadline_ = never;
  Instant inactive_at_; ///< when the ball falls asleep unless something keeps it awake
  bool warned_ = false;
  Instant deaf_until_{}; ///< the dead time after a collision
  Instant watch_at_ = never;
  bool was_moving_ = false;
  int battery_state_ = 2;
  Duration clock_offset_{};
};

} // namespace orb::vm
