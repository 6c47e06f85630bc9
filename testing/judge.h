#pragma once

#include "base/message.h"
#include "run/run.h"
#include "testing/text/test_file.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// Judges: one for each expectation of a run. They are told what the ball is like, what happens and
// how it ended, and keep their verdict, whether it is certain already, and how near it was.

namespace orb::testing {

/// What the names of an expectation stand for in one program.
struct Meaning {
  const report::Zone* zone = nullptr;
  std::optional<int> macro;            ///< the id
  std::optional<std::size_t> variable; ///< of vm::Machine::variable()
  std::size_t packed_bytes = 0;        ///< of the program's image
  std::string other_ball;              ///< the name of Expectation::other_ball
  Message problem; ///< why it can never be met: the program has no such name; else empty
  std::vector<Meaning> joined;          ///< of Expectation::joined
  std::shared_ptr<const Meaning> other; ///< of Expectation::other
};

/// What can be seen of a ball, in the world in which it woke up at 0,0 facing +Y.
struct Sighting {
  double x = 0;
  double y = 0;
  double heading = 0;
  double speed = 0;
  bool moving = false;
  bool has_moved = false; ///< now or before
  bool over = false;      ///< nothing runs any more
  bool asleep = false;
  vm::Color color;
  int back = 0;
  std::vector<vm::Point> balls; ///< where all balls of the room are; empty for one ball
};

/// What ran: a line of the robot's program, or a command of a macro. Zeros: nothing any more.
struct Running {
  int line = 0;
  int macro = 0;
  int command = 0;
};

/// Where in the run something was seen.
struct Moment {
  Duration t{};
  Running running;
};

/// A line that the program printed, without its line end.
struct PrintedLine {
  std::string_view text;
};

/// What the judges are told at the end.
struct Outcome {
  const run::Ending* ending = nullptr;
  const vm::Ball* ball = nullptr;
  Duration over{}; ///< when nothing ran any more
  double way_cm = 0;
  std::uint64_t lines = 0;
};

class Judge {
public:
  virtual ~Judge() = default;

  /// The ball was like this from `from.t` until `to`. Spans follow each other without a gap; a span
  /// of no time is a state that nobody could see for long. The last one has no end: vm::never.
  virtual void see(const Moment& /*from*/, Duration /*to*/, const Sighting&) {}
  virtual void on_print(const Moment&, const PrintedLine&) {}
  virtual void on_marker(const Moment&, const vm::event::Marker&) {}
  virtual void on_bump(const Moment&, const vm::event::Bump&) {}
  virtual void on_error(const Moment&, const run::ProgramError&) {}
  /// Nothing more will be told of what lies before `t`.
  virtual void on_time(Duration /*t*/) {}
  /// The run is over: what is open now is decided.
  virtual void on_end(const Moment&, const Outcome&) {}

  enum class Verdict : std::uint8_t { Open, Met, Missed };
  Verdict verdict() const { return verdict_; }
  bool certain() const { return verdict_ != Verdict::Open; }
  /// What was seen instead, for an expectation that was missed.
  const Message& seen() const { return seen_; }
  /// Where in the run it was met or missed; nothing where that is no one moment.
  const std::optional<Moment>& moment() const { return moment_; }

protected:
  void meet(std::optional<Moment> moment = std::nullopt) {
    verdict_ = Verdict::Met;
    moment_ = moment;
  }
  void miss(Message seen, std::optional<Moment> moment = std::nullopt) {
    verdict_ = Verdict::Missed;
    seen_ = std::move(seen);
    moment_ = moment;
  }

private:
  Verdict verdict_ = Verdict::Open;
  Message seen_;
  std::optional<Moment> moment_;
};

/// The judge of an expectation; both arguments must outlive it.
std::unique_ptr<Judge> make_judge(const Expectation& expectation, const Meaning& meaning);

/// The judge of an expectation that is After or Before another.
std::unique_ptr<Judge> make_order_judge(const Expectation& expectation, const Meaning& meaning);

/// Whether its judge looks at where the ball is at every step.
bool watches_steps(const Expectation& expectation);

/// `3.1 s`, to a hundredth; `0.7 ms` where that would be nothing.
std::string words(Duration t);

} // namespace orb::testing
