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

// A run as a session in time: it goes forward until something is found, and back by running again,
// because a run is a pure function of what it is given. Copies of the whole ball, some at any time
// and never more than a bound, save it from running again from the start.

namespace orb::debug {

/// A place in a run where it can stand still. A step is a line of a program or a command of a
/// macro. Between two steps there is one moment at which the next one is about to begin, and before
/// that one for each instant at which all that runs waits.
struct Moment {
  std::uint64_t step = 0; ///< steps that have been made
  bool about_to = false;  ///< the next one begins now; of two moments the later one
  Instant at{};           ///< where it waits

  friend bool operator==(const Moment& a, const Moment& b) {
    return a.step == b.step && a.about_to == b.about_to && (a.about_to || a.at == b.at);
  }
  friend bool operator<(const Moment& a, const Moment& b) {
    if (a.step != b.step || a.about_to != b.about_to)
      return a.step != b.step ? a.step < b.step : b.about_to;
    return !a.about_to && a.at < b.at;
  }
};

/// What a search looks for. Each question is asked while the timeline stands at the place in
/// question, and `true` stops it there. Wherever a search begins, it finds the same places.
class Watch {
public:
  virtual ~Watch() = default;
  /// A search begins here, or begins again at a place from which it looks forward.
  virtual void begin() {}
  /// Whether line() is to be asked; if not, lines run at full speed.
  virtual bool wants_lines() const { return true; }
  /// A line of a program is about to run.
  virtual bool line() { return false; }
  /// A command of a macro is about to begin.
  virtual bool command() { return false; }
  /// Something has happened.
  virtual bool event(const vm::Event&) { return false; }
  /// Going back, what was found last counts so far: it lies before the place to go back from.
  virtual void noted() {}
  /// The ball has taken a step of its motion, at that time since the start.
  virtual bool motion(Duration) { return false; }
};

// What a user changes at a moment. It happens again whenever the run passes that moment.

struct SetVariable {
  std::size_t index = 0; ///< as in vm::Ball::set_variable
  std::int32_t value = 0;
};
struct GoToLine {
  int line = 0;
};
struct GiveNumber { ///< for `input`
  std::int32_t value = 0;
};
using Edit = std::variant<SetVariable, GoToLine, GiveNumber, vm::Stimulus, run::Felt>;

/// Why a search came back.
enum class Halt : std::uint8_t {
  Found,
  Time,    ///< the instant that was given
  Over,    ///< the run is over, or waits for a number that nobody brings; backwards: its beginning
  GivenUp, ///< whoever asked does not want it any more
  Lost,    ///< the robot that is driven: lost()
};

/// Asked now and then whether a search is still wanted.
using GiveUp = std::function<bool()>;

/// Hears what happens, each thing once: not when it happens again on the way back, unless something
/// was changed before it.
class Audience {
public:
  virtual ~Audience() = default;
  virtual void on_event(Duration t, const vm::Event& event) = 0;
};

class Timeline final : vm::Observer, vm::StepObserver, vm::Gate {
public:
  /// Brings the inputs into a ball and starts them, up to the moment before the first step.
  /// `options.bound` does not count; inputs and options outlive the timeline. With a `robot`, which
  /// may be null, the run drives that, is as fast as it, and goes only forward.
  static tl::expected<std::unique_ptr<Timeline>, Failure> start(std::span<const run::Input> inputs,
                                                                const run::Options& options,
                                                                Audience& audience,
                                                                run::HeldRobot* robot);
  ~Timeline();

  // Where it stands.
  Moment now() const;
  /// The same in robot time since the start; of a line that is about to run, its beginning.
  Duration time() const { return instant() - start_; }
  Instant instant() const;
  const vm::Ball& ball() const { return *ball_; }
  /// What a program would read now.
  std::int32_t sensor(spec::Variable variable) const;
  /// What is about to begin.
  enum class Next : std::uint8_t { Nothing, Line, Command };
  Next next() const;
  /// Nothing runs, or it waits for a number that nobody brings.
  bool over() const;
  bool waits_for_number() const;
  /// Whether it drives a robot.
  bool drives() const { return robot_ != nullptr; }
  /// Why the robot can be driven no more.
  const std::optional<Failure>& lost() const { return lost_; }

  // Going.
  /// Whether a search begins, or goes on where it was given up.
  enum class How : std::uint8_t { Begins, GoesOn };
  /// Goes on until `watch` finds something, at the latest to robot time `until`. What it stands
  /// before is not found again, unless the search goes on.
  Halt forward(Watch& watch, Duration until, const GiveUp& give_up, How how = How::Begins);
  /// Brakes the robot that is driven, where a search was given up and nobody goes on with it. Every
  /// other end of a search does so by itself.
  void hold();
  /// Goes to the last place before this one that `watch` would have found; to the beginning where
  /// there is none. Given up, it stands where it stood.
  Halt back(Watch& watch, const GiveUp& give_up);
  /// Goes to a moment at which this run has stood.
  void go_to(Moment moment);
  /// Goes to the beginning and forgets all changes.
  void begin_again();
  /// Changes something now. What was changed later than now is forgotten. False where it cannot be.
  bool change(const Edit& edit);

  /// Tells the journey all that has happened until now.
  void tell(report::Journey& journey);

  /// What going back costs in memory.
  struct Size {
    std::size_t copies = 0; ///< of the ball
    std::size_t bytes = 0;  ///< of all of them, about
  };
  Size size() const;

private:
  Timeline(std::span<const run::Input> inputs, const run::Options& options, Audience& audience,
           run::HeldRobot* robot);
  tl::expected<void, Failure> start();

  struct Copy;
  struct Search;
  enum class Reached : std::uint8_t { Bound, Found, Time, Over, GivenUp, Lost };
  /// Tells the robot what the run says, but for what it says again on its way to a place where it
  /// has been.
  class Voice final : public vm::Elsewhere {
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
  bool may_begin(bool is_line);

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
  void resolve(Instant at, bool about_to);

  std::span<const run::Input> inputs_;
  const run::Options& options_;
  Audience& audience_;
  run::HeldRobot* robot_; ///< null: the body is a virtual one
  Voice voice_;
  bool robot_goes_ = false; ///< nobody holds it
  std::optional<Failure> lost_;
  vm::NativePrograms native_; ///< machine code that all copies share
  std::unique_ptr<vm::Ball> ball_;
  Instant start_{};
  std::uint64_t commands_ = 0; ///< of macros that have begun
  std::uint64_t events_ = 0;
  std::uint64_t told_ = 0;  ///< events that the audience has heard of
  std::size_t applied_ = 0; ///< edits
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
