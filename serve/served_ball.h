#pragma once

#include "disk/lock.h"
#include "serve/control.h"
#include "serve/fake_bluez.h"
#include "serve/link.h"
#include "serve/packet_spacer.h"
#include "serve/server.h"
#include "vm/robot_v2.h"

#include <asio/steady_timer.hpp>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>

namespace orb::serve {

/// One ball in real time, with its links, its client and its files.
class ServedBall final : private Door, private vm::Observer {
public:
  using Clock = std::chrono::steady_clock;

  /// The `index`-th ball of those that `options` ask for; they and `bluez` must outlive it.
  /// `bluez` is null where there is no Bluetooth LE.
  ServedBall(asio::io_context& io, const ServeOptions& options, int index, FakeBluez* bluez);

  /// Opens its links and files.
  tl::expected<void, IoError> open();
  /// Begins to live; `start` is the moment at which balls have time 0.
  void start(Clock::time_point start);
  /// Does what is asked, and answers in a line without its end.
  std::string obey(const Control& control);
  /// It is not served any more.
  void end();
  /// A line per link.
  std::string addresses() const;
  /// Writes the state file, where there is one.
  tl::expected<void, IoError> save();
  /// Why a file could not be written, if one could not.
  const std::optional<IoError>& error() const { return error_; }

private:
  bool admits() override;
  void enter(Link& link) override;
  void moved(const Link& link) override { options_.announce(link.address() + "\n"); }
  void leave();
  void on_event(Instant at, const vm::Event& event) override {
    spectator_->on_event(at + born_.time_since_epoch(), event);
  }

  vm::BallOptions ball_options();
  void make_ball();
  void reset();
  std::string state() const;
  std::string asleep() const;
  tl::expected<void, IoError> load();
  tl::expected<void, IoError> open_pty();
  tl::expected<void, IoError> open_tcp(const ServeOptions::Tcp& place);
  void open_ble(FakeBluez& bluez);

  Instant now() const;
  Instant real_time() const;
  /// Moments of the ball's own time, which begins anew with each reset, as moments since the start.
  Instant since_start(Instant own) const {
    return own == never ? never : own + born_.time_since_epoch();
  }
  void live_until(Instant time) { ball_->advance_to(time - born_.time_since_epoch()); }
  std::string numbered(const std::string& name) const;

  void wait_client(Link::Ready ready, void (ServedBall::*handler)());
  void await_input();
  void on_input();
  void step();
  void hear(ByteView bytes);
  void take_packets();
  void take_v2_packets();
  void send_faulty();
  void write(ByteView bytes);
  void write_backlog();
  void on_writable();
  void lose_client();
  void arm();
  void log(protocol::Direction direction, ByteView bytes);
  void fail(const IoError& error);

  asio::io_context& io_;
  const ServeOptions& options_;
  int index_;
  FakeBluez* bluez_;
  Spectator* spectator_; ///< null for none
  Instant born_{};       ///< when the ball began to live: at the start, or at the last reset
  std::optional<vm::Ball> ball_;
  std::optional<vm::RobotV2> robot_; ///< that the ball is, where it speaks packets v2
  std::optional<protocol::FaultPipe> pipe_;
  Clock::time_point start_;
  asio::steady_timer timer_;
  Clock::time_point armed_ = Clock::time_point::max();

  std::vector<std::unique_ptr<Link>> links_;
  Link* client_ = nullptr;    ///< the link on which the client is
  std::uint64_t session_ = 0; ///< tells the handlers of a client that left from those of the next
  PacketSpacer spacer_;
  Bytes backlog_; ///< what the client has not taken yet
  bool writing_ = false;
  bool reading_ = false;

  std::ofstream log_;
  std::optional<disk::Lock> lock_; ///< on the state
  std::uint64_t saved_revision_ = 0;
  std::optional<IoError> error_;
};

} // namespace orb::serve
