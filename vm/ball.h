#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "spec/firmware.h"
#include "vm/api/dispatcher.h"
#include "vm/api/streamer.h"
#include "vm/body/ask.h"
#include "vm/body/body.h"
#include "vm/body/shake_sense.h"
#include "vm/common/link.h"
#include "vm/common/observer.h"
#include "vm/common/power.h"
#include "vm/common/settings.h"
#include "vm/drive.h"
#include "vm/lamps.h"
#include "vm/machine/programs.h"
#include "vm/macros/macro_executive.h"
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
  spec::Robot robot = spec::Robot::Sphero; ///< determines battery and axes
  spec::Driving driving;                   ///< driving characteristics
  Placement start;                         ///< starting place and direction in its world
  Wire wire = Wire::Paced;
  Observer* observer = nullptr;  ///< must outlive the ball
  StepObserver* steps = nullptr; ///< sees every step of the body; must outlive the ball
};

/// A ball: a discrete-event simulation driven by the caller's clock. It jumps from one event to the
/// next, so advancing a ball at rest costs nothing. Within one instant the order is: control
/// system, stimuli, dispatcher, macro, streaming, orbBasic.
///
/// It keeps the time, the link and that order, and connects its parts: executives (dispatcher,
/// macros, programs) decide but hold no physics; the body holds the physics but knows no program;
/// Lamps, Drive and Power decide whose colour shows, who may drive and when the ball sleeps. Large
/// because the API, programs, macros, stimuli and debuggers all act on a ball here; most members
/// only pass the request on to one of its parts.
class Ball final {
public:
  explicit Ball(const BallOptions& options);
  ~Ball();
  /// Copies the ball with all its state. The copy reports to the same observers and asks the same
  /// gate.
  Ball(const Ball& other);
  Ball& operator=(const Ball&) = delete;

  // The link.
  /// Connects a client and wakes a sleeping ball.
  void connect();
  void disconnect();
  bool connected() const { return link_.connected(); }
  /// Takes bytes from the client, at now().
  void receive(ByteView bytes);
  /// Returns what has left the ball until now(): whole packets, paced at 11 520 bytes a second.
  Bytes take_output();
  /// Returns one packet that has left, or nullopt.
  std::optional<Bytes> take_packet() { return link_.take(now_); }

  // Time.
  Instant now() const { return now_; }
  /// Says whether the caller looks at the ball at the target of an advance. With `Look`, a ball
  /// that has come to rest reports so at the target. With `Pass` it reports at the next event, so
  /// results do not depend on how the caller slices time.
  enum class Halt : std::uint8_t { Look, Pass };
  /// Runs everything that is due up to and including `target`.
  void advance_to(Instant target, Halt halt = Halt::Look);
  /// As advance_to(), but returns as soon as the ball is quiet() or its observer calls interrupt().
  void advance_until_quiet(Instant target, Halt halt = Halt::Look);
  /// As advance_to(), but returns as soon as a packet has left for the client.
  void advance_until_output(Instant target, Halt halt = Halt::Look);
  /// Returns true if nothing runs or will run by itself: no program, no macro, no wake-up, and all
  /// output has left. Also true for a program that waits for input no script will supply.
  bool quiet() const { return idle() && link_.waiting(now_) == 0; }
  /// As quiet(), but output may still be leaving.
  bool idle() const;
  /// The start of the present idle time, as seen by advance_until_quiet().
  std::optional<Instant> idle_since() const { return idle_since_; }
  /// Returns true if the last advance returned because the gate held a program or macro.
  bool held() const { return programs_.machine().held() || macros_.held(); }
  /// Makes advance_until_quiet() return after the present event or line.
  void interrupt() {
    interrupted_ = true;
    programs_.interrupt();
  }
  /// The next event, including output that leaves; `never` at rest.
  Instant next_event() const;

  /// Sends events to `observer` from now on; null: to nobody.
  void tell(Observer* observer) { observer_ = observer; }
  /// Tells `observer` of every step of the body from now on; null: nobody.
  void tell_steps(StepObserver* observer) { body_.observe(observer); }

  // The world.
  /// Applies a stimulus now.
  void apply(const Stimulus& stimulus);
  /// Schedules the events of a script. Their times count from now().
  void schedule(std::span<const TimedStimulus> script);

  // Among other balls.
  /// Applies the contact with other balls, now. `names` are the names of all balls.
  void meet(const Shove& shove, std::span<const std::string> names);
  /// Advances to `target` if only motion is due until then. Returns false if the ball stopped short
  /// or motion caused an event; advance_to() must then continue. A fast path for callers that
  /// advance in tiny pieces with `Pass` and call only meet() in between.
  bool coast(Instant target);
  /// The time of the script's next push; `never` if it has none.
  Instant next_push() const;

  // A remote robot as the body.
  /// Replaces body and lamps by a remote robot, which must outlive the ball. Programs, arbitration
  /// and time work as before.
  void become(RemoteBody& robot);
  /// Takes a sensor sample of the robot, at now().
  void feel(const Sample& sample);
  /// Takes a collision reported by the robot.
  void feel(const event::Collision& collision);

  // Requests, as a client makes them.
  void drive(const Motion& motion) { drive(Actor::Client, motion); }
  /// Sets the application colour, which programs also read as the colour of cmdrgb.
  void set_led(Color color) { set_led(Actor::Client, color); }
  /// Reports a new picture of the LED matrix to the observer. The ball itself ignores it.
  void show_matrix(const std::array<Color, 64>& pixels);
  void change(const Settings& settings);
  Outcome erase_basic(Area area) { return programs_.erase(area); }
  Outcome append_basic(Area area, ByteView text) { return programs_.append(area, text); }
  Outcome execute_basic(Area area, int line) { return programs_.execute(area, line, now_); }
  /// Queues a number for the next waiting `input`, like a client that answers at once.
  void queue_input(std::int32_t value) { programs_.queue_input(value); }
  bool input_queued() const { return programs_.input_queued(); }
  MacroOutcome run_macro(int id);
  /// Restores the state kept across power cycles.
  void restore(const Settings& settings, const Profile& profile);

  // Changes made by a debugger.
  /// Sets A to Y (0 to 24), or an element of Z (from bytecode::first_element).
  void set_variable(std::size_t index, std::int32_t value) { programs_.set_variable(index, value); }
  /// Continues the program at that line. Returns false if no program runs or it lacks the line.
  bool go_to_line(int line) { return programs_.go_to(line, now_); }

  // State.
  const Body& body() const { return body_; }
  /// Returns what a program would read, but clears nothing. Timers are read as of `at`.
  std::int32_t peek(spec::Variable variable, Instant at) const;
  Color led() const { return lamps_.shown(); }
  /// Returns true while the identification colours blink: no client is connected and no colour is
  /// set.
  bool blinks() const { return lamps_.next_blink(lamp_situation()) != never; }
  bool asleep() const { return power_.asleep(); }
  const Settings& settings() const { return settings_; }
  /// Returns the profile with its lifetime counters up to date.
  const Profile& profile() { return dispatcher_.profile(); }
  const Dispatcher& dispatcher() const { return dispatcher_; }
  const Streamer& streamer() const { return streamer_; }
  const MacroExecutive& macros() const { return macros_; }
  const Machine& machine() const { return programs_.machine(); }
  bool basic_running() const { return programs_.running(); }
  /// The area of the program that runs or ran last.
  Area basic_area() const { return programs_.area(); }
  std::string_view basic_text(Area area) const { return programs_.text(area); }

private:
  struct Asks; ///< requests by programs, macros and the API: vm/ball_asks.h

  enum class Until : std::uint8_t { Target, Quiet, Output };
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

  std::vector<TimedStimulus> script_; ///< times count from power-on; latest first
  bool interrupted_ = false;
  std::optional<Instant> idle_since_;
  bool double_shake_ = false;
  ShakeSense shakes_;    ///< detects shakes of a remote robot
  Instant deaf_until_{}; ///< end of the dead time after a collision
  Instant watch_at_ = never;
  std::optional<Instant> felt_at_; ///< time of the remote robot's last sample
  bool was_moving_ = false;
  Instant calm_until_{};     ///< until then only motion is due, as of the last advance
  bool rest_unseen_ = false; ///< it came to rest during `Pass` and has not reported it
};

} // namespace orb::vm
