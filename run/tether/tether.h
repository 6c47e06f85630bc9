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

// What is said of a robot, whoever drives it.
inline constexpr std::string_view stop_done = "the robot has been stopped";
inline constexpr std::string_view stop_lost =
    "the robot has not acknowledged the stop; it stops by itself 2 s after the last command: make "
    "sure that it does";
inline constexpr std::string_view samples_gone =
    "no sensor data: the robot was told to stop, and the program is waiting";
inline constexpr std::string_view samples_back = "sensor data is back: the program continues";

/// Waits, repetitions and limits of a run on a robot that is elsewhere.
struct TetherBudgets {
  CollisionLimits collisions;
  Duration answer = 400ms;    ///< for one answer; then the request is sent again
  Duration setup = 6s;        ///< for an answer to each request before the run
  Duration repeat = 800ms;    ///< a drive command is repeated so often while the robot drives
  Duration stale = 500ms;     ///< without a sample for so long the robot is stopped
  Duration gone = 5s;         ///< without one for so long the run ends
  Duration first_sample = 3s; ///< for the first one
  Duration stop = 4s;         ///< for a stop to be acknowledged at the end
  Duration rest = 1500ms;     ///< for the robot to come to rest then
  Duration busy = 5s;         ///< for a robot that says that it is busy
  Duration teardown = 800ms;  ///< for each of the last answers
  Duration battery = 10s;     ///< its voltage is asked for so often
};

/// A robot at the other end of a link, as the body of a ball. Set-points wait here, the latest of a
/// kind wins; they leave no faster than the robot takes them. A stop is never dropped, overtakes
/// what waits and is repeated until it is acknowledged. However it is left, the robot is told to
/// stop.
class Tether final : public vm::Elsewhere {
public:
  /// `streamed`: what it streams besides where it is.
  Tether(protocol::Transport& transport, spec::Robot robot, const TetherBudgets& budgets,
         const Streamed& streamed = {});
  /// Stops the robot where finish() has not been called.
  ~Tether() override;
  Tether(const Tether&) = delete;
  Tether& operator=(const Tether&) = delete;

  /// Readies the robot and waits for its first sample.
  /// The failure says which step failed; the robot has been stopped then.
  tl::expected<vm::Sample, Failure> begin(Aim aim);

  /// Brakes the robot and silences it, whoever holds it. Fails where it has not acknowledged that.
  tl::expected<void, Failure> hold();
  /// Lets it speak again and drive as it did when it was held.
  tl::expected<void, Failure> go_on();

  void obey(const vm::Motion& motion) override;
  void show(vm::Color color) override;
  void show_back(int level) override;
  /// Sends a request once nothing more urgent waits, after those given before. What is given so
  /// paints over what show() shows, so a newer show() drops what waits.
  void send_soon(Request request) { soon_.push_back(std::move(request)); }

  /// Sends what is due and waits for news until `deadline` at the latest. What the robot has said
  /// goes to `hear`. The failure is why the run cannot go on.
  tl::expected<void, Failure> pump(Instant deadline, const std::function<void(const Said&)>& hear);
  Instant now() const { return transport_->now(); }
  /// The voltage of its battery when it was readied; nothing where it does not tell.
  const std::optional<vm::stimulus::Battery>& battery() const { return battery_; }
  /// How long ago the newest sample came.
  Duration sample_age() const { return now() - sample_at_; }
  bool is_stale() const { return stale_; }

  /// The link's time without the pauses in which nobody pumped: a program's time does not jump over
  /// what it would have done while the computer slept.
  Instant program_now() const { return now() - slept_ - slept_since(looked_at_); }
  /// Why the run was no success, where only its end tells: the robot was busy all the time.
  std::optional<Failure> verdict() const;

  /// Whether the link broke while the robot was to be stopped.
  bool link_lost() const { return link_lost_; }
  /// From now on the link is this one: the old one was lost.
  void relink(protocol::Transport& transport);
  /// The same as finish(), bit by bit for who may not wait: pump() brakes the robot, then puts it
  /// back as it was, one request after the other, without its answers.
  void wind_up();
  /// Nothing is left to send. Whether the brake was acknowledged: acknowledged().
  bool is_wound_up() const { return winding_up_ && parting_.empty(); }
  bool acknowledged() const { return stopped_; }
  /// Brakes the robot, watches it until it rests, puts it back as it was. Whether the brake was
  /// acknowledged. What it says meanwhile goes to `hear`.
  bool finish(const std::function<void(const Said&)>& hear = {});

private:
  /// What a request is about: of a kind the latest wins. The most urgent first.
  enum class Kind : std::uint8_t {
    Stabilization,
    Drive,
    Rate,
    Lamp,
    Matrix,
    BackLamp,
    Battery,
    Stop, ///< a step of a stop: they wait in a list of their own and go before all others
    Other
  };
  static constexpr std::size_t kinds = static_cast<std::size_t>(Kind::Other);
  struct Pending {
    Request request;
    std::uint8_t seq = 0;
    Instant sent{};
    Kind kind = Kind::Other;
  };

  /// It answers `busy` to requests of a kind.
  struct Busy {
    Instant since;
    Instant last;
  };

  std::optional<Request>& waiting(Kind kind) { return waiting_[static_cast<std::size_t>(kind)]; }
  bool waits(Kind kind) const { return waiting_[static_cast<std::size_t>(kind)].has_value(); }
  bool may_leave(Kind kind) const;
  /// The answer; nothing where it refuses what a run can do without.
  tl::expected<std::optional<Bytes>, Failure> ask(const Request& request, Duration budget);
  tl::expected<void, Failure> ask_all(const std::vector<Request>& requests);
  tl::expected<vm::Sample, Failure> listen();
  tl::expected<void, protocol::LinkError> send(const Request& request, Kind kind);
  tl::expected<void, protocol::LinkError> send_due();
  Instant next_due() const;
  void send_again(const Pending& pending);
  void give_up_waiting();
  std::optional<vm::stimulus::Battery> take(const Said::Answer& answer);
  bool brake(const std::function<void(const Said&)>& hear);
  void await_rest(const std::function<void(const Said&)>& hear);
  void watch_samples();
  std::deque<Request> stop_steps();
  void begin_stop(std::deque<Request> steps, bool whole);
  void want_stop();
  void take_step(const Pending& step, bool done);
  void resume(std::optional<Request> drive);
  void drive_motors(vm::Motors motors);
  bool acknowledges(const Request& request, Instant until,
                    const std::function<void(const Said&)>& hear);
  void stop_acknowledged();
  Duration slept_since(Instant expected) const;
  void notice_pause(Instant expected);
  void notice_slow_write();
  Failure refusal(const Request& request, std::uint8_t error) const;
  Failure lost(const protocol::LinkError& error) const;

  protocol::Transport* transport_;
  spec::Robot robot_;
  TetherBudgets budgets_;
  std::unique_ptr<RobotWire> wire_;
  Streamed streamed_;
  std::uint8_t seq_ = 0;

  std::array<std::optional<Request>, kinds> waiting_; ///< to leave
  std::array<std::uint8_t, kinds> newest_{};          ///< sequence number of the newest sent
  std::array<std::optional<Busy>, kinds> busy_{};
  std::deque<Request> stopping_; ///< steps of a stop: each leaves once the last is acknowledged
  bool stop_open_ = false;       ///< the first of them has been sent and not been answered
  bool stops_whole_ = false;     ///< the steps end with the roll of 0, and none was refused
  bool link_lost_ = false;
  std::optional<Request> driving_; ///< the last that left and keeps it moving: repeated
  std::deque<Request> parting_;    ///< to be sent after the brake
  bool winding_up_ = false;
  bool stopped_ = false;        ///< the brake of wind_up() was acknowledged
  bool loose_ = false;          ///< raw motors or no stabilization: it ignores a roll of speed 0
  bool stabilized_ = true;      ///< what the program wants
  bool has_driven_ = false;     ///< it took a command that drives it
  vm::Motors motors_;           ///< as set last
  std::optional<Request> held_; ///< what it is to drive once nobody holds it
  Instant driven_at_{};
  int heading_ = 0;
  std::deque<Request> soon_; ///< of send_soon()
  std::deque<Pending> open_; ///< sent, not answered
  std::optional<vm::stimulus::Battery> battery_;
  std::optional<Failure> refused_;

  std::optional<Instant> battery_at_; ///< when it is asked for next, which keeps the robot awake
  Instant next_send_{};
  Instant sample_at_{};
  int facing_deg_ = 0; ///< in the newest sample
  Instant looked_at_{};
  Duration slept_{}; ///< of all pauses
  bool stale_ = false;
  bool began_ = false;
  bool finished_ = false;
};

} // namespace orb::run
