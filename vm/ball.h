#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "spec/firmware.h"
#include "vm/api/dispatcher.h"
#include "vm/api/streamer.h"
#include "vm/body/ask.h"
#include "vm/body/body.h"
#include "vm/body/shake_sense.h"
#include "vm/drive.h"
#include "vm/lamps.h"
#include "vm/link.h"
#include "vm/macros/macro_executive.h"
#include "vm/observer.h"
#include "vm/power.h"
#include "vm/programs.h"
#include "vm/settings.h"
#include "vm/stimulus.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace orb::vm {

struct BallOptions : ProgramOptions {
  std::uint64_t seed = 1;
  spec::Firmware firmware = spec::default_firmware;
  spec::Robot robot = spec::Robot::Sphero; ///< whose battery and axes it has
  spec::Driving driving;                   ///< how it drives
  Placement start;                         ///< where it stands in its world
  Wire wire = Wire::Paced;
  Observer* observer = nullptr;  ///< must outlive the ball
  StepObserver* steps = nullptr; ///< the same; sees every step of the body
};

/// A ball. A discrete-event simulation that is handed the time: it jumps from one thing that can
/// happen to the next, and a ball at rest costs nothing to advance. At one instant things happen in
/// this order: control system, stimuli, dispatcher, macro, streaming, orbBasic.
///
/// It keeps time, the link and that order, and stands between its parts: executives (dispatcher,
/// macros, programs) decide and hold no physics, the body has physics and knows no program, and
/// Lamps, Drive and Power say whose colour shows, who may drive and whether the ball is awake.
class Ball final {
public:
  explicit Ball(const BallOptions& options);
  ~Ball();
  /// A ball that has come just as far, with the same observers and the same gate.
  Ball(const Ball& other);
  Ball& operator=(const Ball&) = delete;

  // The link.
  /// A client connects; a sleeping ball wakes up.
  void connect();
  void disconnect();
  bool connected() const { return link_.connected(); }
  /// Bytes from the client, at now().
  void receive(ByteView bytes);
  /// What has left the ball until now(): whole packets, at 11 520 bytes a second.
  Bytes take_output();
  /// The same, a packet at a time; nothing when none has left.
  std::optional<Bytes> take_packet() { return link_.take(now_); }

  // Time.
  Instant now() const { return now_; }
  /// Whether the target of an advance is itself a moment at which the ball is looked at: then a
  /// ball that has come to rest since it was last seen is seen to rest there, not only at what
  /// happens next. With `Pass` it does not matter into how many pieces time is cut.
  enum class Halt : std::uint8_t { Look, Pass };
  /// Lets everything happen that is due up to and including `target`.
  void advance_to(Instant target, Halt halt = Halt::Look);
  /// The same, but comes back as soon as the ball is quiet(), or its observer calls interrupt().
  void advance_until_quiet(Instant target, Halt halt = Halt::Look);
  /// Nothing runs or will run by itself: no program, no macro, no wake-up, and all output has left.
  /// A program that waits for a number that nobody will bring is quiet, too.
  bool quiet() const { return idle() && link_.waiting(now_) == 0; }
  /// The same, but output may still be leaving.
  bool idle() const;
  /// Since when it is idle, as far as advance_until_quiet() has seen.
  std::optional<Instant> idle_since() const { return idle_since_; }
  /// The gate let the program or the macro go no further, so that the ball came back.
  bool held() const { return programs_.machine().held() || macros_.held(); }
  /// Lets advance_until_quiet() come back after the present event, or line.
  void interrupt() {
    interrupted_ = true;
    programs_.interrupt();
  }
  /// When something happens next by itself, output that leaves included; `never` at rest.
  Instant next_event() const;

  // The world.
  /// Lets a stimulus happen now.
  void apply(const Stimulus& stimulus);
  /// Lets the events of a script happen, their times counted from now().
  void schedule(std::span<const TimedStimulus> script);

  // Among others.
  /// Other balls press on it or have run into it, now; `names` are those of all balls.
  void meet(const Shove& shove, std::span<const std::string> names);
  /// Moves on to `target`, if nothing but motion is due until then and nothing comes of that.
  /// False: it moved less far or not at all, or something has come of it; advance_to() goes on from
  /// there. A short cut for who advances in tiny pieces, with `Pass`, and does nothing to it in
  /// between but meet().
  bool coast(Instant target);
  /// When the next push of the script comes; `never` without one.
  Instant next_push() const;

  // Elsewhere.
  /// From now on a robot that is elsewhere is its body and its lamps; it must outlive the ball. The
  /// ball is the same otherwise: programs, who drives, whose colour shows, time.
  void become(Elsewhere& robot);
  /// What the robot says of itself, at now().
  void feel(const Sample& sample);
  /// The robot says that it ran into something.
  void feel(const event::Collision& collision);

  // Asks, as a client has them.
  void drive(const Motion& motion) { drive(Actor::Client, motion); }
  /// The application colour; it is also what cmdrgb tells programs.
  void set_led(Color color) { set_led(Actor::Client, color); }
  /// Its matrix of lamps shows this picture from now on: observers are told, each time. The ball
  /// itself has no use for it.
  void show_matrix(const std::array<Color, 64>& pixels);
  void change(const Settings& settings);
  Outcome erase_basic(Area area) { return programs_.erase(area); }
  Outcome append_basic(Area area, ByteView text) { return programs_.append(area, text); }
  Outcome execute_basic(Area area, int line) { return programs_.execute(area, line, now_); }
  void abort_basic();
  /// A number for the next `input` that waits: a client that answers at once.
  void queue_input(std::int32_t value) { programs_.queue_input(value); }
  bool input_queued() const { return programs_.input_queued(); }
  MacroOutcome run_macro(int id);
  /// Takes over what outlives a power cycle.
  void restore(const Settings& settings, const Profile& profile);

  // What a debugger changes.
  /// A to Y (0 to 24), or an element of Z (from bytecode::first_element).
  void set_variable(std::size_t index, std::int32_t value) { programs_.set_variable(index, value); }
  /// The program goes on at that line; false where none runs that has it.
  bool go_to_line(int line) { return programs_.go_to(line, now_); }

  // What can be seen.
  const Body& body() const { return body_; }
  /// What a program would read, without what reading clears; of a timer, as of `at`.
  std::int32_t peek(spec::Variable variable, Instant at) const;
  Color led() const { return lamps_.shown(); }
  /// Nobody is connected and nobody has set a colour: it shows who it is.
  bool blinks() const { return lamps_.next_blink(lamp_situation()) != never; }
  bool asleep() const { return power_.asleep(); }
  const Settings& settings() const { return settings_; }
  /// The counters of its life are as of now.
  const Profile& profile() { return dispatcher_.profile(); }
  const Dispatcher& dispatcher() const { return dispatcher_; }
  const Streamer& streamer() const { return streamer_; }
  const MacroExecutive& macros() const { return macros_; }
  const Machine& machine() const { return programs_.machine(); }
  bool basic_running() const { return programs_.running(); }
  /// Where the program lies that runs, or ran last.
  Area basic_area() const { return programs_.area(); }
  std::string_view basic_text(Area area) const { return programs_.text(area); }

private:
  struct Asks; ///< what programs, macros and the API ask: vm/ball_asks.h

  enum class Until : std::uint8_t { Target, Quiet };
  void advance(Instant target, Until until, Halt halt);
  Instant next_of_others() const;
  Instant next_step() const { return asleep() ? never : body_.next_step(); }
  Instant next_step_of_note() const;
  void catch_up();
  void run_events(Instant others);
  bool pass(Instant target);
  void run_script();
  void run_housekeeping();
  void settle();
  void finish_program();
  void watch_motion();
  void detect_collision(const Impact& impact);
  void check_battery();
  void watch_battery();

  void drive(Actor actor, const Motion& motion);
  void share_drive();
  void set_led(Actor actor, Color color);
  void set_back_led(int level);
  Lamps::Situation lamp_situation() const;
  void show_lamps();

  void stay_awake() { power_.stay_awake(now_, settings_); }
  bool keeps_awake() const;
  void fall_asleep();
  void wake();
  void shut_down();

  void send(const protocol::Async& async) { link_.send(async, now_); }
  void trace(const Event& event);

  std::unique_ptr<Asks> asks_;
  Observer* observer_;
  Gate* gate_;
  Instant now_{};
  Settings settings_;
  Body body_;
  Link link_;
  Lamps lamps_;
  Drive drive_;
  Power power_;
  Programs programs_;
  MacroExecutive macros_;
  Streamer streamer_;
  Dispatcher dispatcher_;

  std::vector<TimedStimulus> script_; ///< `at` counts from the ball's power-on; latest first
  bool interrupted_ = false;
  std::optional<Instant> idle_since_;
  bool double_shake_ = false;
  ShakeSense shakes_;    ///< of a robot that is elsewhere
  Instant deaf_until_{}; ///< the dead time after a collision
  Instant watch_at_ = never;
  std::optional<Instant> felt_at_; ///< when a robot elsewhere said something last
  bool was_moving_ = false;
  Instant calm_until_{};     ///< since the last advance nothing but motion is due until then
  bool rest_unseen_ = false; ///< it has come to rest while it was not looked at
};

} // namespace orb::vm
