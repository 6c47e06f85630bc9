#pragma once

#include "debug/expression.h"
#include "debug/hit_condition.h"
#include "debug/sources.h"
#include "debug/timeline.h"

#include "run/want.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// The debugger behind both the editor adapter and the terminal: breakpoints, stepping by source
// lines, frames, variables by name.

namespace orb::debug {

/// Why a run on a robot cannot go back.
inline constexpr std::string_view no_way_back =
    "a robot cannot run backwards: set an earlier breakpoint and start again, or omit the "
    "port";

/// What runs. A ball can run both at once.
enum class Thread : std::uint8_t { Program, Macro };

enum class Move : std::uint8_t {
  Continue, ///< to the next breakpoint
  In,       ///< to the next line
  Over,     ///< the same, but not into subs
  Out,      ///< to after the return from this sub
};

enum class Direction : std::uint8_t { Forward, Back };

/// What a breakpoint waits for.
struct Breakpoint {
  enum class Kind : std::uint8_t {
    Line,      ///< the line at `spot` is about to run
    Sub,       ///< the sub `text` begins
    Change,    ///< the value of `expression` changed
    Condition, ///< `expression` became true
  };
  Kind kind = Kind::Line;
  int id = 0;
  std::vector<Spot> spots;              ///< Line, Sub; empty: can never be reached
  std::optional<Expression> expression; ///< Change, Condition
  std::optional<Expression> only_if;
  HitCondition which;   ///< which hits count; only going forward
  std::string log;      ///< printed in place of stopping, with `{expression}` filled in
  std::string text;     ///< as the user wrote it
  bool by_name = false; ///< Sub: matches by name; otherwise by `spots`
  std::uint64_t hits = 0;
};

/// Why a run stopped, and details to report.
struct StopEvent {
  enum class Reason : std::uint8_t {
    Step,
    Breakpoint,
    Fault, ///< the robot's error: `text`
    Time,  ///< the requested time was reached
    Input, ///< waits for a number
    End,
    Begin,   ///< reached the beginning while going back
    GivenUp, ///< interrupted: continue with resume()
    Robot,   ///< the driven robot cannot do this, or is lost: `text`
  };
  Reason reason = Reason::Step;
  std::vector<int> breakpoints; ///< the ones that were hit
  std::string text;             ///< `turns: 3, was 2`; for a fault its message
};

struct StackFrame {
  std::string name; ///< of the sub, or of a macro
  std::optional<Spot> spot;
  int number = 0; ///< of the robot's line, or of the command
};

/// A named value.
struct Variable {
  std::string name;
  std::string value;
  std::string note = {};                     ///< its letter or unit
  std::optional<std::size_t> register_ = {}; ///< set if it can be changed
};

/// Receives what is printed during a run.
class Console {
public:
  virtual ~Console() = default;
  virtual void print(std::string_view text) = 0; ///< output of the program
  virtual void say(std::string_view text) = 0;   ///< a line from the debugger
};

/// Stops a run, shows its state and changes it. Large because the editor adapter and the terminal
/// use the same interface, with a member for everything that one of them shows or changes.
class Debugger final : Audience, Watch, Meaning {
public:
  /// Inputs, options, console and robot must outlive it; the robot may be null.
  static tl::expected<std::unique_ptr<Debugger>, Failure> start(std::span<const run::Input> inputs,
                                                                const run::Options& options,
                                                                Console& console,
                                                                run::HeldRobot* robot = nullptr);
  ~Debugger();

  const Sources& sources() const { return sources_; }
  Timeline& timeline() { return *timeline_; }
  const Timeline& timeline() const { return *timeline_; }

  /// Parses an expression to wait for; fails with a sentence for invalid ones and unknown names.
  tl::expected<Expression, std::string> expression(std::string_view text) const;

  // Breakpoints. Ids are never reused.
  Breakpoint& add(Breakpoint breakpoint);
  /// Returns false for an unknown id.
  bool remove(int id);
  void remove_all(Breakpoint::Kind kind, std::optional<std::uint32_t> file = std::nullopt);
  const std::vector<Breakpoint>& breakpoints() const { return breakpoints_; }
  void stop_at_faults(bool stop) { stop_at_faults_ = stop; }

  // Running.
  StopEvent go(Move move, Direction direction, Thread thread, const GiveUp& give_up);
  StopEvent go_until(Duration time, const GiveUp& give_up);
  /// Continues an interrupted move.
  StopEvent resume(const GiveUp& give_up);
  /// Goes back to the beginning; fails with a sentence if impossible.
  tl::expected<void, std::string> restart();
  /// Moves execution to a source line; returns false if no code begins there.
  bool jump(Spot spot);

  // Inspecting.
  Thread thread() const; ///< the thread that runs next
  bool runs(Thread thread) const;
  std::vector<StackFrame> frames(Thread thread) const;
  /// The line that is about to run or waits; after a fault, the line of the fault.
  std::optional<Spot> spot() const;
  tl::expected<std::int32_t, std::string> evaluate(std::string_view text) const;
  /// The names that expressions may use, here or elsewhere in the run.
  std::vector<std::string_view> names() const;
  /// What the program waits for that neither the stimuli nor the user provide.
  std::optional<run::Want> want() const;
  std::vector<Variable> variables() const;
  std::vector<std::string> arrays() const;
  std::vector<Variable> elements(std::string_view array) const;
  std::vector<Variable> sensors() const;
  std::vector<Variable> ball() const;
  std::vector<Variable> limits() const;
  /// The fault that ended the run at the current moment.
  const std::optional<run::ProgramError>& fault() const { return fault_; }

  // Changing. False or a sentence means it is impossible.
  tl::expected<std::int32_t, std::string> set(std::string_view name, std::string_view value);
  bool give_number(std::int32_t value);
  tl::expected<void, std::string> happen(const vm::Stimulus& stimulus);

private:
  Debugger(std::span<const run::Input> inputs, const run::Options& options, Console& console);

  // Audience
  void on_event(Duration t, const vm::Event& event) override;
  // Watch
  void begin() override;
  bool wants_lines() const override;
  bool line() override;
  bool command() override;
  bool event(const vm::Event& event) override;
  void noted() override {
    noted_ = found_;
    noted_at_ = found_at_;
  }
  bool motion(Duration t) override;
  // Meaning
  std::optional<std::int32_t> variable(std::string_view name) const override;
  std::string missing(std::string_view name) const override;
  std::optional<std::int32_t> element(std::string_view name, std::int32_t index) const override;
  std::int32_t sensor(spec::Variable variable) const override;

  StopEvent run(const GiveUp& give_up);
  StopEvent stop_of(Halt halt);
  /// Call depth: calls of the robot, then calls of the source inlined in the last one.
  struct Depth {
    std::size_t calls = 0;
    std::size_t level = 0;
    friend auto operator<=>(const Depth&, const Depth&) = default;
  };
  /// The levels at which the run can stop before a robot line that begins source subs: at each
  /// call, and last at the line itself.
  struct Levels {
    std::size_t first = 0; ///< outermost possible level
    std::size_t at = 0;    ///< current level
  };

  const Sources::Line* program_line() const;
  Levels innermost() const;
  std::size_t calls(Thread thread) const;
  Depth depth(Thread thread) const;
  int robot_line() const; ///< the line that is about to run, waits, or failed
  std::size_t first_new(const Sources::Line& line) const;
  bool stops_at(const Sources::Line& line, std::size_t level, std::size_t first_new);
  bool goes_on(const Sources::Line& line, std::size_t level) const;
  bool runs_on(const Sources::Line& line) const;
  bool stops_within_line();
  void stand(Levels levels);
  void stand_outermost();
  Levels stands() const;
  bool hit_place(Spot spot);
  bool hit_sub(std::string_view name);
  bool hit_values();
  bool steps_here(Thread thread, Depth here, bool begins);
  bool counts(Breakpoint& one);
  std::string filled(std::string_view text) const;
  std::optional<std::size_t> register_of(std::string_view name) const;
  std::optional<std::size_t> element_register(std::string_view name, std::int32_t index) const;

  std::span<const run::Input> inputs_;
  run::Options options_;
  Console& console_;
  Sources sources_;
  std::vector<Breakpoint> breakpoints_;
  int next_id_ = 1;
  bool stop_at_faults_ = true;
  bool is_helped_ = false; ///< the user has caused an event
  std::unique_ptr<Timeline> timeline_;
  std::optional<run::ProgramError> fault_;

  // The current move.
  Move move_ = Move::Continue;
  Direction direction_ = Direction::Forward;
  Thread thread_ = Thread::Program;
  Depth from_depth_;
  Duration until_ = Duration::max();
  Timeline::How how_ = Timeline::How::Begins;
  std::optional<Duration> moving_at_;  ///< time of the motion step being checked
  std::map<int, std::int64_t> values_; ///< of Change and Condition, by breakpoint id
  StopEvent found_;
  StopEvent noted_; ///< the same for going back
  Levels found_at_; ///< belongs to found_
  Levels noted_at_; ///< belongs to noted_
  Levels stands_;   ///< at `stands_when_`; later the innermost
  Moment stands_when_;
  const Sources::Line* before_ = nullptr; ///< the previous line; null if unknown
  std::size_t calls_before_ = 0;          ///< open calls of the robot at that line
};

} // namespace orb::debug
