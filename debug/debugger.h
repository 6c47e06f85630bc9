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

// What debuggers have in common, whether an editor or a person at a terminal speaks to them:
// breakpoints, stepping by lines of the source, frames, variables by their names.

namespace orb::debug {

/// Why a run on a robot is not gone back.
inline constexpr std::string_view no_way_back =
    "a robot cannot run backwards: set an earlier breakpoint and start again, or omit the "
    "port";

/// Who runs. A ball has both at once.
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
    Line,      ///< the line `spot` is about to run
    Sub,       ///< the sub `text` begins
    Change,    ///< the value of `expression` has changed
    Condition, ///< `expression` has become true
  };
  Kind kind = Kind::Line;
  int id = 0;
  std::vector<Spot> spots;              ///< Line, Sub; none: it can never be reached
  std::optional<Expression> expression; ///< Change, Condition
  std::optional<Expression> only_if;
  HitCondition which;   ///< of its hits count; forward only
  std::string log;      ///< said in place of stopping, with `{expression}` filled in
  std::string text;     ///< as it was asked for
  bool by_name = false; ///< Sub: waits until that name begins; else for `spots`
  std::uint64_t hits = 0;
};

/// Why a run stands still, and what is to be said of it.
struct Stop {
  enum class Reason : std::uint8_t {
    Step,
    Breakpoint,
    Fault, ///< the robot's error: `text`
    Time,  ///< the instant that was asked for
    Input, ///< it waits for a number
    End,
    Begin,   ///< going back, it came to its beginning
    GivenUp, ///< it is to go on when there is time again: resume()
    Robot,   ///< the robot that is driven cannot do that, or is lost: `text`
  };
  Reason reason = Reason::Step;
  std::vector<int> breakpoints; ///< that were hit
  std::string text;             ///< `turns: 3, was 2`; of a fault its message
};

struct Frame {
  std::string name; ///< of the sub; of a macro
  std::optional<Spot> spot;
  int number = 0; ///< the robot's line, or the command
};

/// A value with its name.
struct Variable {
  std::string name;
  std::string value;
  std::string note = {};                     ///< the letter; the unit
  std::optional<std::size_t> register_ = {}; ///< where it can be changed
};

/// Hears what is to be printed while a run goes on.
class Console {
public:
  virtual ~Console() = default;
  virtual void print(std::string_view text) = 0; ///< what the program prints
  virtual void say(std::string_view text) = 0;   ///< what the debugger says: a line
};

class Debugger final : Audience, Watch, Meaning {
public:
  /// Inputs, options, console and the robot, which may be null, outlive it.
  static tl::expected<std::unique_ptr<Debugger>, Failure> start(std::span<const run::Input> inputs,
                                                                const run::Options& options,
                                                                Console& console,
                                                                run::HeldRobot* robot = nullptr);
  ~Debugger();

  const Sources& sources() const { return sources_; }
  Timeline& timeline() { return *timeline_; }
  const Timeline& timeline() const { return *timeline_; }

  /// An expression to wait for; a sentence where it is none, or no name of the program.
  tl::expected<Expression, std::string> expression(std::string_view text) const;

  // Breakpoints. An id is never given twice.
  Breakpoint& add(Breakpoint breakpoint);
  /// False where there is none.
  bool remove(int id);
  void remove_all(Breakpoint::Kind kind, std::optional<std::uint32_t> file = std::nullopt);
  const std::vector<Breakpoint>& breakpoints() const { return breakpoints_; }
  void stop_at_faults(bool stop) { stop_at_faults_ = stop; }

  // Going.
  Stop go(Move move, Direction direction, Thread thread, const GiveUp& give_up);
  Stop go_until(Duration time, const GiveUp& give_up);
  /// Goes on with what was given up.
  Stop resume(const GiveUp& give_up);
  /// Back to before the first step; a sentence where it cannot be.
  tl::expected<void, std::string> restart();
  /// The program goes on at a line of the source; false where nothing begins there.
  bool jump(Spot spot);

  // Looking.
  Thread thread() const; ///< the one that is about to go on
  bool runs(Thread thread) const;
  std::vector<Frame> frames(Thread thread) const;
  /// The line that is about to run, or waits; the one where it failed.
  std::optional<Spot> spot() const;
  tl::expected<std::int32_t, std::string> evaluate(std::string_view text) const;
  /// What an expression may name, here or elsewhere in the run.
  std::vector<std::string_view> names() const;
  /// What the program looks for and nobody brings about, the user included.
  std::optional<run::Want> want() const;
  std::vector<Variable> variables() const;
  std::vector<std::string> arrays() const;
  std::vector<Variable> elements(std::string_view array) const;
  std::vector<Variable> sensors() const;
  std::vector<Variable> ball() const;
  std::vector<Variable> limits() const;
  /// The fault that ended the run, as of now.
  const std::optional<run::ProgramError>& fault() const { return fault_; }

  // Changing. False, or a sentence, where it cannot be.
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

  Stop run(const GiveUp& give_up);
  Stop stop_of(Halt halt);
  /// How deep in calls something is: those of the robot, then those of the source within the last.
  struct Depth {
    std::size_t calls = 0;
    std::size_t level = 0;
    friend auto operator<=>(const Depth&, const Depth&) = default;
  };
  /// Where a line of the robot that begins subs of the source can be stood before: at the call of
  /// each, and at last at the line itself.
  struct Levels {
    std::size_t first = 0; ///< the outermost at which it can
    std::size_t at = 0;    ///< at which it does
  };

  const Sources::Line* program_line() const;
  Levels innermost() const;
  std::size_t calls(Thread thread) const;
  Depth depth(Thread thread) const;
  int robot_line() const; ///< that is about to run, waits, or has failed
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
  bool is_helped_ = false; ///< the user has made something happen
  std::unique_ptr<Timeline> timeline_;
  std::optional<run::ProgramError> fault_;

  // The way that is being gone.
  Move move_ = Move::Continue;
  Direction direction_ = Direction::Forward;
  Thread thread_ = Thread::Program;
  Depth from_depth_;
  Duration until_ = Duration::max();
  Timeline::How how_ = Timeline::How::Begins;
  std::optional<Duration> moving_at_;  ///< the time of the motion that is being looked at
  std::map<int, std::int64_t> values_; ///< of Change and Condition, by id
  Stop found_;
  Stop noted_;      ///< the same, going back
  Levels found_at_; ///< of found_
  Levels noted_at_; ///< of noted_
  Levels stands_;   ///< at `stands_when_`; later the innermost
  Moment stands_when_;
  const Sources::Line* before_ = nullptr; ///< the line that ran before; null: not known
  std::size_t calls_before_ = 0;          ///< open calls of the robot then
};

} // namespace orb::debug
