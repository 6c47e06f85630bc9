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

// Judges: one for each expectation of a run. A judge sees the state of the ball, the events and the
// end of the run. It keeps its verdict, knows when the verdict is final, and describes the nearest
// miss.

namespace orb::testing {

/// What the names in an expectation refer to in one program.
struct Meaning {
  const report::Zone* zone = nullptr;
  std::optional<int> macro;            ///< its id
  std::optional<std::size_t> variable; ///< index for vm::Machine::variable()
  std::size_t packed_bytes = 0;        ///< size of the program's image
  std::string other_ball;              ///< name of Expectation::other_ball
  Message problem;             ///< why it can never be met, such as an unknown name; else empty
  std::vector<Meaning> joined; ///< for Expectation::joined
  std::shared_ptr<const Meaning> other; ///< for Expectation::other
};

/// The observable state of a ball, in the world in which it woke up at 0,0 facing +Y.
struct Sighting {
  double x = 0;
  double y = 0;
  double heading = 0;
  double speed = 0;
  bool moving = false;
  bool has_moved = false; ///< now or before
  bool over = false;      ///< the run has ended
  bool asleep = false;
  vm::Color color;
  int back = 0;
  std::vector<vm::Point> balls; ///< positions of all balls of the room; empty for a single ball
};

/// What ran: a line of the robot's program, or a command of a macro. Zeros when nothing runs.
struct Running {
  int line = 0;
  int macro = 0;
  int command = 0;
};

/// The point of the run at which something was seen.
struct Moment {
  Duration t{};
  Running running;
};

/// A line that the program printed, without its line end.
struct PrintedLine {
  std::string_view text;
};

/// What the judges learn at the end of a run.
struct Outcome {
  const run::Ending* ending = nullptr;
  const vm::Ball* ball = nullptr;
  Duration over{}; ///< when the last program or macro ended
  double way_cm = 0;
  std::uint64_t lines = 0;
};

class Judge {
public:
  virtual ~Judge() = default;

  /// The state of the ball from `from.t` until `to`. Spans follow each other without a gap. A span
  /// may have no length: a state too short to see. The last one is open-ended: vm::never.
  virtual void see(const Moment& /*from*/, Duration /*to*/, const Sighting&) {}
  virtual void on_print(const Moment&, const PrintedLine&) {}
  virtual void on_marker(const Moment&, const vm::event::Marker&) {}
  virtual void on_bump(const Moment&, const vm::event::Bump&) {}
  virtual void on_error(const Moment&, const run::ProgramError&) {}
  /// Everything before `t` has been reported.
  virtual void on_time(Duration /*t*/) {}
  /// The run is over: decides what is still open.
  virtual void on_end(const Moment&, const Outcome&) {}

  enum class Decision : std::uint8_t { Open, Met, Missed };
  Decision decision() const { return decision_; }
  bool certain() const { return decision_ != Decision::Open; }
  /// What was seen instead, if the expectation was missed.
  const Message& seen() const { return seen_; }
  /// The moment at which it was met or missed; nothing if there is no single one.
  const std::optional<Moment>& moment() const { return moment_; }

protected:
  void meet(std::optional<Moment> moment = std::nullopt) {
    decision_ = Decision::Met;
    moment_ = moment;
  }
  void miss(Message seen, std::optional<Moment> moment = std::nullopt) {
    decision_ = Decision::Missed;
    seen_ = std::move(seen);
    moment_ = moment;
  }

private:
  Decision decision_ = Decision::Open;
  Message seen_;
  std::optional<Moment> moment_;
};

/// Makes the judge of an expectation; both arguments must outlive it.
std::unique_ptr<Judge> make_judge(const Expectation& expectation, const Meaning& meaning);

/// Makes the judge of an expectation that is After or Before another.
std::unique_ptr<Judge> make_order_judge(const Expectation& expectation, const Meaning& meaning);

/// True if the judge needs the position of the ball at every step.
bool watches_steps(const Expectation& expectation);

/// `3.1 s`, to a hundredth; `0.7 ms` for times that would round to nothing.
std::string words(Duration t);

} // namespace orb::testing
