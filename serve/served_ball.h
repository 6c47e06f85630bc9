#pragma once

#include "disk/lock.h"
#include "serve/control.h"
#include "serve/fake_bluez.h"
#include "serve/link.h"
#include "serve/packet_spacer.h"
#include "serve/server.h"
#include "vm/device.h"

#include <asio/steady_timer.hpp>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>

namespace orb::serve {

/// One ball in real time, with its links, client and files. Large because its asynchronous handlers
/// all work on the same ball, client and pending output.
class ServedBall final : private Door, private vm::Observer {
public:
  using Clock = std::chrono::steady_clock;

  /// The `index`-th ball requested by `options`; they and `bluez` must outlive it. `bluez` is null
  /// without Bluetooth LE.
  ServedBall(asio::io_context& io, const ServeOptions& options, int index, FakeBluez* bluez);

  /// Opens links and files.
  tl::expected<void, IoError> open();
  /// Starts the ball; `start` is time 0 of all balls.
  void start(Clock::time_point start);
  /// Executes a control line. Returns the answer, a line without its end.
  std::string obey(const Control& control);
  /// Stops serving.
  void end();
  /// One line per link.
  std::string addresses() const;
  /// Writes the state file, if there is one.
  tl::expected<void, IoError> save();
  /// The latest failure to write a file, if any.
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
  /// Converts the ball's own time, which restarts with each reset, to time since the start.
  Instant since_start(Instant own) const {
    return own == never ? never : own + born_.time_since_epoch();
  }
  void live_until(Instant time) { device_->advance_to(time - born_.time_since_epoch()); }
  vm::Ball& ball() { return device_->ball(); }
  const vm::Ball& ball() const { return device_->ball(); }
  std::string numbered(const std::string& name) const;

  void wait_client(Link::Ready ready, void (ServedBall::*handler)());
  void await_input();
  void on_input();
  void step();
  void take_packets();
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
  Spectator* spectator_; ///< may be null
  Witness* witness_;     ///< may be null
  Instant born_{};       ///< time 0 of the ball: the start, or the last reset
  std::optional<vm::Device> device_;
  std::optional<protocol::FaultPipe> pipe_;
  Clock::time_point start_;
  asio::steady_timer timer_;
  Clock::time_point armed_ = Clock::time_point::max();

  std::vector<std::unique_ptr<Link>> links_;
  Link* client_ = nullptr;    ///< the link of the present client
  std::uint64_t session_ = 0; ///< tells handlers of a departed client from those of the next
  PacketSpacer spacer_;
  Bytes backlog_; ///< output that the client has not taken
  bool writing_ = false;
  bool reading_ = false;

  std::ofstream log_;
  std::optional<disk::Lock> lock_; ///< on the state file
  std::uint64_t saved_revision_ = 0;
  std::optional<IoError> error_;
};

} // namespace orb::serve
