#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/link_faults.h"
#include "report/course.h"
#include "report/journey.h"
#include "spec/firmware.h"
#include "spec/robots.h"
#include "vm/device.h"
#include "vm/room/room.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// A robot at the level of bytes, in virtual time: takes what a client would write, returns what the
// robot would send; the caller advances the time. No thread, clock or file: the same calls give the
// same bytes.

namespace orb::robot {

/// Converts a time to seconds, for people and other languages.
constexpr double in_seconds(Duration time) {
  return std::chrono::duration<double>(time).count();
}

/// What a robot records.
enum class Keep : std::uint8_t {
  State,  ///< only its present state: for thousands of robots
  Journey ///< its path and events, for pages and drawings: a few megabytes at most
};

struct Options {
  std::string name;                                 ///< in its world; empty: its number there
  std::uint64_t seed = 1;                           ///< for noise, address and `rnd`
  vm::Placement start;                              ///< cm, degrees clockwise from +Y
  spec::Firmware firmware = spec::default_firmware; ///< for robots that run orbBasic
  std::optional<spec::Driving> driving;             ///< as measured; nullopt: those of its kind
  std::optional<protocol::FaultPlan> fault;         ///< faults of the link to the client
  Keep keep = Keep::Journey;
};

/// The state of a robot at one moment.
struct State {
  Duration t{};     ///< since power-on
  vm::Pose pose;    ///< cm, degrees, cm/s, in its world
  vm::Color rgb;    ///< of the main light
  int back_led = 0; ///< 0 to 255
  /// Shown instead of `rgb`; rows from the bottom left.
  std::optional<std::array<vm::Color, 64>> matrix;
  double volts = 0;    ///< of the battery
  int charge = 0;      ///< of the battery, percent
  double way_cm = 0;   ///< distance driven
  bool asleep = false; ///< a robot with packets v2 until it is woken; it still answers
  bool connected = false;
  bool program_runs = false;
  bool macro_runs = false;
  bool drives = false;          ///< driven by a client or program
  std::uint64_t collisions = 0; ///< detected under the client's settings, sent or not
  std::uint64_t bumps = 0;      ///< with walls and other robots, detected or not
};

class World;

/// A virtual robot with packets v1 or v2, alone or in a World. Large because it is the whole
/// interface to a robot: link, time, state and world.
class Robot final : private vm::Observer, private vm::Resident {
public:
  /// Creates a robot alone on a floor with the walls of `course`.
  explicit Robot(spec::Robot kind, Options options = {}, report::Course course = {});
  ~Robot() override;
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Copies the robot with all its state. Null for a robot in a World, which is forked as a whole.
  std::unique_ptr<Robot> fork() const;
  /// Resets the whole world to time 0; the client stays connected.
  void reset();

  // The client's end of the link.
  /// Connects a client and wakes a sleeping classic robot.
  void connect();
  void disconnect();
  /// Sleep disconnects the client, and so does a fault plan that cuts the link.
  bool connected() const;
  /// Takes bytes from the client, now, in pieces of any size. Without a connection they are lost.
  void write(ByteView bytes);
  /// Returns the bytes that have arrived at the client by now.
  Bytes read();

  // Time.
  Duration now() const;
  /// Advances the time of the whole world. A negative duration counts as 0.
  void advance(Duration time);
  /// The next event; nullopt at rest, when only write() or stimulus() can cause more.
  std::optional<Duration> next_event() const;

  // State.
  State state() const;
  const spec::RobotInfo& kind() const { return spec::info(kind_); }
  const Options& options() const { return options_; }
  /// Twelve digits derived from the seed.
  std::string address() const;
  /// Returns its journey so far, ended now for a page or drawing; empty with Keep::State.
  report::Journey journey() const;
  const vm::Ball& ball() const { return device_->ball(); }

  // The world.
  /// Applies a line of a stimulus script: `push 90 120` happens now, `at 2s shake` at 2 s of the
  /// robot's time. The error is a sentence.
  tl::expected<void, std::string> stimulus(std::string_view line);
  /// From now on it moves like a remote robot that has sent this sample.
  void feel(const vm::Sample& sample);
  void feel(const vm::event::Collision& collision) { device_->ball().feel(collision); }
  /// Schedules the events of a script. Their times count from now().
  void schedule(std::span<const vm::TimedStimulus> script) { device_->ball().schedule(script); }
  /// Tells `events` and `steps` what happens to it from now on, until reset(); null: nobody. Forks
  /// are not watched.
  void watch(vm::Observer* events, vm::StepObserver* steps);

private:
  friend class World;

  Robot(const Robot& other, World* world);
  void make();
  void restart();
  void live_until(Instant time);
  void hear(ByteView bytes);
  void exchange();

  void on_event(Instant at, const vm::Event& event) override;

  void advance_to(Duration t) override { live_until(Instant{t}); }
  vm::Mover mover() const override { return ball().body().mover(); }
  vm::Outlook outlook() const override;
  void meet(const vm::Shove& shove, std::span<const std::string> names) override;

  spec::Robot kind_;
  Options options_;
  report::Course course_;
  World* world_ = nullptr;
  std::optional<vm::Device> device_;
  std::optional<protocol::FaultPipe> pipe_;
  Bytes arrived_; ///< not yet read
  std::optional<std::array<vm::Color, 64>> matrix_;
  int back_led_ = 0;
  std::uint64_t collisions_ = 0;
  std::uint64_t bumps_ = 0;
  std::optional<report::Journey> journey_;
  vm::Observer* watcher_ = nullptr;
};

/// Several robots on one floor, which collide with each other.
class World final {
public:
  explicit World(report::Course course = {}) : course_(std::move(course)) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Adds a robot that starts now and lives as long as the world. Fails with a sentence if the name
  /// is taken or the place overlaps another robot.
  tl::expected<Robot*, std::string> add(spec::Robot kind, Options options = {});
  const std::vector<std::unique_ptr<Robot>>& robots() const { return robots_; }

  Duration now() const { return room_.now(); }
  /// Advances the time of all robots. A negative duration counts as 0.
  void advance(Duration time);
  void reset();
  std::unique_ptr<World> fork() const;

private:
  void join(Robot& robot) { room_.add(robot.options_.name, robot); }

  report::Course course_;
  vm::Room room_;
  std::vector<std::unique_ptr<Robot>> robots_;
};

} // namespace orb::robot
