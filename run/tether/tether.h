#pragma once

#include "base/exit_code.h"
#include "protocol/transport.h"
#include "run/tether/wire.h"

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace orb::run {

// Messages about a robot, shared by all commands that drive one.
inline constexpr std::string_view stop_done = "the robot has been stopped";
inline constexpr std::string_view stop_lost =
    "the robot has not acknowledged the stop; it stops by itself 2 s after the last command: make "
    "sure that it does";
inline constexpr std::string_view samples_gone =
    "no sensor data: the robot was told to stop, and the program is waiting";
inline constexpr std::string_view samples_back = "sensor data is back: the program continues";

/// Time-outs, repetition intervals and limits of a run on a remote robot.
struct TetherBudgets {
  CollisionLimits collisions;
  Duration answer = 400ms;    ///< for one answer; then the request is repeated
  Duration setup = 6s;        ///< for an answer to each request before the run
  Duration repeat = 800ms;    ///< repetition interval of a drive command while the robot drives
  Duration stale = 500ms;     ///< without a sample for this long the robot is stopped
  Duration gone = 5s;         ///< without one for this long the run ends
  Duration first_sample = 3s; ///< for the first sample
  Duration stop = 4s;         ///< for the final stop to be acknowledged
  Duration rest = 1500ms;     ///< for the robot to come to rest afterwards
  Duration busy = 5s;         ///< for a robot that answers busy
  Duration teardown = 800ms;  ///< for each of the last answers
  Duration battery = 10s;     ///< interval of asking for its voltage
};

/// Opens a lost link again; null if that is impossible or the robot has stopped by itself.
using Reopen = std::function<std::unique_ptr<protocol::Transport>()>;

/// A robot at the other end of a link, used as the body of a ball. Set-points wait here, and the
/// latest of a kind replaces earlier ones; they are sent no faster than the robot takes them. A
/// stop is never dropped, overtakes waiting requests and is repeated until acknowledged. The
/// destructor stops the robot. Large because what may leave next depends on everything that waits,
/// is unanswered or has failed.
class Tether final : public vm::RemoteBody {
public:
  /// `streamed`: what it streams besides its place. `reopen` may be empty.
  Tether(protocol::Transport& transport, spec::Robot robot, const TetherBudgets& budgets,
         const Streamed& streamed = {}, Reopen reopen = {});
  /// Stops the robot unless finish() or wind_up() has been called.
  ~Tether() override;
  Tether(const Tether&) = delete;
  Tether& operator=(const Tether&) = delete;

  /// Prepares the robot and waits for its first sample. The failure names the step that failed; the
  /// robot has then been stopped.
  tl::expected<vm::Sample, Failure> begin(Aim aim);

  /// Brakes and silences the robot. Fails if the brake is not acknowledged.
  tl::expected<void, Failure> hold();
  /// Resumes streaming and driving as before hold().
  tl::expected<void, Failure> go_on();

  void obey(const vm::Motion& motion) override;
  void show(vm::Color color) override;
  void show_back(int level) override;
  /// Queues a request of low priority, in order. Such requests paint over show(), so a newer show()
  /// drops them.
  void send_soon(Request request) { soon_.push_back(std::move(request)); }
  /// True if none of these is pending.
  bool has_sent_soon() const { return soon_.empty(); }
  /// True if nothing is pending.
  bool is_idle() const;

  /// Sends what is due and waits for news until `deadline` at the latest. Passes news to `hear`.
  /// Fails if the run cannot continue.
  tl::expected<void, Failure> pump(Instant deadline,
                                   const std::function<void(const RobotMessage&)>& hear);
  Instant now() const { return transport_->now(); }
  /// Battery voltage when it was prepared; nullopt if it does not report it.
  const std::optional<vm::stimulus::Battery>& battery() const { return battery_; }
  /// Age of the newest sample.
  Duration sample_age() const { return now() - sample_at_; }
  bool is_stale() const { return stale_; }

  /// The link's time without pauses of pumping: a program must not skip what it would have done
  /// while the computer slept.
  Instant program_now() const { return now() - slept_ - slept_since(looked_at_); }
  /// Returns a failure that shows only at the end of a run: the robot was busy all the time.
  std::optional<Failure> verdict() const;

  /// Returns true if finish() had to open the link again.
  bool is_reopened() const { return again_ != nullptr; }
  /// Replaces a lost link.
  void relink(protocol::Transport& transport);
  /// As finish(), but without blocking: pump() brakes the robot, then restores it with one request
  /// after another, without waiting for answers.
  void wind_up();
  /// Returns true if nothing is left to send. acknowledged() says whether the brake was.
  bool is_wound_up() const { return winding_up_ && parting_.empty(); }
  bool acknowledged() const { return stopped_; }
  /// The packets that stop the robot in its present state, for the owner of the link if this object
  /// can no longer send.
  Bytes stop_packets();
  /// Brakes the robot, follows it until it rests and restores it. Returns true if the brake was
  /// acknowledged. Passes news to `hear`. Opens a lost link again for that, and the next if that is
  /// lost, too: a port that comes back may be taken before it works.
  bool finish(const std::function<void(const RobotMessage&)>& hear = {});

private:
  /// Kinds of requests, the most urgent first. The latest of a kind wins.
  enum class Kind : std::uint8_t {
    Stabilization,
    Drive,
    Rate,
    Lamp,
    Matrix,
    BackLamp,
    Battery,
    Stop, ///< a step of a stop: queued separately and sent before all others
    Other
  };
  static constexpr std::size_t kinds = static_cast<std::size_t>(Kind::Other);
  struct Pending {
    Request request;
    std::uint8_t seq = 0;
    Instant sent{};
    Kind kind = Kind::Other;
  };

  /// The robot answers `busy` to requests of a kind.
  struct Busy {
    Instant since;
    Instant last;
  };

  std::optional<Request>& waiting(Kind kind) { return waiting_[static_cast<std::size_t>(kind)]; }
  bool waits(Kind kind) const { return waiting_[static_cast<std::size_t>(kind)].has_value(); }
  bool may_leave(Kind kind) const;
  /// Returns the answer; nullopt if the robot refuses an optional request.
  tl::expected<std::optional<Bytes>, Failure> ask(const Request& request, Duration budget);
  tl::expected<void, Failure> ask_all(const std::vector<Request>& requests);
  tl::expected<vm::Sample, Failure> listen();
  tl::expected<void, protocol::LinkError> send(const Request& request, Kind kind);
  tl::expected<void, protocol::LinkError> send_due();
  Instant next_due() const;
  void send_again(const Pending& pending);
  void give_up_waiting();
  std::optional<vm::stimulus::Battery> take(const RobotMessage::Answer& answer);
  bool finish_here(const std::function<void(const RobotMessage&)>& hear);
  bool brake(const std::function<void(const RobotMessage&)>& hear);
  void await_rest(const std::function<void(const RobotMessage&)>& hear);
  void watch_samples();
  std::deque<Request> stop_steps();
  void begin_stop(std::deque<Request> steps);
  void want_stop();
  void take_step(const Pending& step, bool done);
  void resume(std::optional<Request> drive);
  void drive_motors(vm::Motors motors);
  bool acknowledges(const Request& request, Instant until,
                    const std::function<void(const RobotMessage&)>& hear);
  void stop_acknowledged();
  Duration slept_since(Instant expected) const;
  void notice_pause(Instant expected);
  void notice_slow_write();
  Failure refusal(const Request& request, std::uint8_t error) const;
  Failure lost(const protocol::LinkError& error) const;

  Reopen reopen_;
  std::unique_ptr<protocol::Transport> again_; ///< the link that replaced a lost one
  protocol::Transport* transport_;
  spec::Robot robot_;
  TetherBudgets budgets_;
  std::unique_ptr<RobotWire> wire_;
  Streamed streamed_;
  std::uint8_t seq_ = 0;

  std::array<std::optional<Request>, kinds> waiting_; ///< not yet sent
  std::array<std::uint8_t, kinds> newest_{}; ///< sequence number of the newest request sent
  std::array<std::optional<Busy>, kinds> busy_{};
  std::deque<Request> stopping_; ///< steps of a stop: each is sent once the one before is answered
  bool stop_open_ = false;       ///< the first step has been sent and not answered
  bool stops_whole_ = false;     ///< the steps end with a roll of 0, and none was refused
  bool link_lost_ = false;
  std::optional<Request> driving_; ///< last request sent that keeps it moving: repeated
  std::deque<Request> parting_;    ///< to be sent after the brake
  bool winding_up_ = false;
  bool stopped_ = false;        ///< the brake of wind_up() was acknowledged
  bool loose_ = false;          ///< raw motors or no stabilization: it ignores a roll of speed 0
  bool stabilized_ = true;      ///< as the program wants it
  bool has_driven_ = false;     ///< it accepted a drive command
  vm::Motors motors_;           ///< last raw motor values
  std::optional<Request> held_; ///< drive request to resume after hold()
  Instant driven_at_{};
  int heading_ = 0;
  std::deque<Request> soon_; ///< queued by send_soon()
  std::deque<Pending> open_; ///< sent but not answered
  std::optional<vm::stimulus::Battery> battery_;
  std::optional<Failure> refused_;

  std::optional<Instant> battery_at_; ///< when to ask next, which also keeps the robot awake
  Instant next_send_{};
  Instant sample_at_{};
  int facing_deg_ = 0; ///< in the newest sample
  Instant looked_at_{};
  Duration slept_{}; ///< sum of all pauses
  bool stale_ = false;
  bool began_ = false;
  bool finished_ = false;
};

} // namespace orb::run
