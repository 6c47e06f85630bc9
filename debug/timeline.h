#pragma once

#include "base/exit_code.h"
#include "base/time.h"
#include "report/journey.h"
#include "run/held_robot.h"
#include "run/run.h"
#include "vm/ball.h"

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

// A run as a timeline. It goes forward until something is found, and back by running again: a run
// is a pure function of its input. Snapshots of the whole ball, limited in number, save running
// again from the start.

namespace orb::debug {

/// A place in a run where it can stop. A step is a line of a program or a command of a macro.
/// Between two steps there is one moment at which the next step is about to begin; before it there
/// is one for each instant at which everything waits.
struct Moment {
  std::uint64_t step = 0; ///< steps made so far
  bool about_to = false;  ///< the next step is about to begin; sorts after the waiting moments
  Instant at{};           ///< time at which it waits

  friend bool operator==(const Moment& a, const Moment& b) {
    return a.step == b.step && a.about_to == b.about_to && (a.about_to || a.at == b.at);
  }
  friend bool operator<(const Moment& a, const Moment& b) {
    if (a.step != b.step || a.about_to != b.about_to)
      return a.step != b.step ? a.step < b.step : b.about_to;
    return !a.about_to && a.at < b.at;
  }
};

/// What a search looks for. The timeline is at the place in question at each call; returning true
/// stops it there. The result does not depend on where a search begins.
class Watch {
public:
  virtual ~Watch() = default;
  /// A search begins, or restarts at a place from which it goes forward.
  virtual void begin() {}
  /// Returns true if line() should be called; otherwise lines run at full speed.
  virtual bool wants_lines() const { return true; }
  /// A program line is about to run.
  virtual bool line() { return false; }
  /// A macro command is about to begin.
  virtual bool command() { return false; }
  /// An event happened.
  virtual bool event(const vm::Event&) { return false; }
  /// Going back: the last find is the best so far, as it is before the starting point.
  virtual void noted() {}
  /// The ball made a motion step, at that time since the start.
  virtual bool motion(Duration) { return false; }
};

// A user's change at a moment. It is repeated whenever the run passes that moment.

struct SetVariable {
  std::size_t index = 0; ///< index for vm::Ball::set_variable
  std::int32_t value = 0;
};
struct GoToLine {
  int line = 0;
};
struct GiveNumber { ///< an answer to `input`
  std::int32_t value = 0;
};
using Edit = std::variant<SetVariable, GoToLine, GiveNumber, vm::Stimulus, run::Felt>;

/// Why a search ended.
enum class Halt : std::uint8_t {
  Found,
  Time, ///< reached the given instant
  /// the run is over, or waits for a number that nobody provides; going back: its beginning
  Over,
  GivenUp, ///< interrupted by the caller
  Lost,    ///< the driven robot failed: lost()
};

/// Called from time to time; returns true to interrupt a search.
using GiveUp = std::function<bool()>;

/// Receives each event once. Events replayed on the way back are not repeated, unless a change was
/// made before them.
class Audience {
public:
  virtual ~Audience() = default;
  virtual void on_event(Duration t, const vm::Event& event) = 0;
};

/// A run that goes forward and back. Large because running, replaying and changing it must keep the
/// ball, its snapshots, the changes and the events told so far consistent.
class Timeline final : vm::Observer, vm::StepObserver, vm::Gate {
public:
  /// Loads and starts the inputs in a ball, up to the moment before the first step. Ignores
  /// `options.bound`; inputs and options must outlive the timeline. With a `robot` (may be null)
  /// the run drives it in real time and only goes forward.
  static tl::expected<std::unique_ptr<Timeline>, Failure> start(std::span<const run::Input> inputs,
                                                                const run::Options& options,
                                                                Audience& audience,
                                                                run::HeldRobot* robot);
  ~Timeline();

  // Position.
  Moment now() const;
  /// The current robot time since the start; for a line that is about to run, its beginning.
  Duration time() const { return instant() - start_; }
  Instant instant() const;
  const vm::Ball& ball() const { return *ball_; }
  /// What a program would read at this moment.
  std::int32_t sensor(spec::Variable variable) const;
  /// What begins next.
  enum class Next : std::uint8_t { Nothing, Line, Command };
  Next next() const;
  /// True if nothing runs, or it waits for a number that nobody provides.
  bool over() const;
  bool waits_for_number() const;
  /// True if it drives a robot.
  bool drives() const { return robot_ != nullptr; }
  /// Why the robot cannot be driven any more.
  const std::optional<Failure>& lost() const { return lost_; }

  // Moving.
  /// A new search, or the continuation of an interrupted one.
  enum class How : std::uint8_t { Begins, GoesOn };
  /// Runs until `watch` finds something, at most to robot time `until`. A new search ignores the
  /// place where it starts.
  Halt forward(Watch& watch, Duration until, const GiveUp& give_up, How how = How::Begins);
  /// Brakes the driven robot after an interrupted search that nobody continues. All other ends of a
  /// search do so themselves.
  void hold();
  /// Goes back to the last place that `watch` would have found, or to the beginning. If
  /// interrupted, stays where it was.
  Halt back(Watch& watch, const GiveUp& give_up);
  /// Goes to a moment at which this run has been.
  void go_to(Moment moment);
  /// Goes to the beginning and drops all changes.
  void begin_again();
  /// Makes a change at this moment and drops later ones. Returns false if it is impossible.
  bool change(const Edit& edit);

  /// Passes everything up to this moment to the journey.
  void tell(report::Journey& journey);

  /// The memory used for going back.
  struct Size {
    std::size_t copies = 0; ///< snapshots of the ball
    std::size_t bytes = 0;  ///< of all snapshots, approximately
  };
  Size size() const;

private:
  Timeline(std::span<const run::Input> inputs, const run::Options& options, Audience& audience,
           run::HeldRobot* robot);
  tl::expected<void, Failure> start();

  struct Copy;
  struct Search;
  enum class Reached : std::uint8_t { Bound, Found, Time, Over, GivenUp, Lost };
  /// Passes commands of the run to the robot, except while replaying to an earlier place.
  class Voice final : public vm::RemoteBody {
  public:
    explicit Voice(run::HeldRobot* robot) : robot_(robot) {}
    bool speaks = false;
    void obey(const vm::Motion& motion) override;
    void show(vm::Color color) override;
    void show_back(int level) override;

  private:
    run::HeldRobot* robot_;
  };

  void on_event(Instant at, const vm::Event& event) override;
  void on_step(Instant at, const vm::Body& body) override;
  std::int64_t lines() override;
  bool command() override;
  bool may_begin(Next what);

  std::uint64_t step() const { return ball_->machine().lines_of_all() + commands_; }
  Copy copy() const;
  void restore(const Copy& copy);
  const Copy& base_before(const Moment& moment) const;
  void keep_copy();
  void copy_near(const Moment& moment);
  Reached run(Search& search);
  Reached advance(Search& search);
  Reached advance_to_bound(Search& search);
  Instant next_look(Instant end) const;
  std::optional<Reached> hear(Search& search);
  Halt search_forward(Search& search);
  bool apply(const Edit& edit);
  void settle();
  void hit(Instant at);
  enum class At : std::uint8_t { NextStep, End };
  void resolve(Instant at, At what);

  std::span<const run::Input> inputs_;
  const run::Options& options_;
  Audience& audience_;
  run::HeldRobot* robot_; ///< null: the body is virtual
  Voice voice_;
  bool robot_goes_ = false; ///< the robot is not held
  std::optional<Failure> lost_;
  vm::NativePrograms native_; ///< machine code shared by all snapshots
  std::unique_ptr<vm::Ball> ball_;
  Instant start_{};
  std::uint64_t commands_ = 0; ///< macro commands begun so far
  std::uint64_t events_ = 0;
  std::uint64_t told_ = 0;  ///< events passed to the audience so far
  std::size_t applied_ = 0; ///< edits applied so far
  struct Change {
    Moment at;
    Edit edit;
  };
  std::vector<Change> edits_;
  std::vector<Copy> copies_; ///< the first is the beginning
  std::unique_ptr<Copy> near_;
  std::uint64_t steps_apart_;
  Duration time_apart_;
  Search* search_ = nullptr;
  report::Journey* journey_ = nullptr;
};

} // namespace orb::debug
