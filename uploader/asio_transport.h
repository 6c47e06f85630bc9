#pragma once

#include "uploader/endpoint.h"

#include <algorithm>
#include <array>
#include <asio.hpp>
#include <cerrno>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

// What the links of an operating system have in common: each is an Asio stream behind the Transport
// interface.

namespace orb::uploader {

using protocol::LinkError;

inline constexpr std::size_t read_most = 4096; // bytes at once

inline tl::unexpected<LinkError> failed(LinkError::Kind kind, std::string message) {
  return tl::unexpected(LinkError{kind, std::move(message)});
}

inline Instant steady_now() {
  return Instant(
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

/// A stream of Asio with deadlines. One operation at a time; an unfinished one is cancelled.
template <class Stream>
class AsioTransport final : public protocol::Transport {
public:
  AsioTransport(std::unique_ptr<asio::io_context> io, Stream stream, Duration write_time, Stop stop)
      : io_(std::move(io)), stream_(std::move(stream)), write_time_(write_time),
        stop_(std::move(stop)) {}

  Instant now() const override { return steady_now(); }

  tl::expected<void, LinkError> write(ByteView bytes) override {
    if (stuck_) // in the middle of a packet
      return failed(LinkError::Kind::Broken, takes_nothing);
    std::optional<asio::error_code> result;
    asio::async_write(stream_, asio::buffer(bytes.data(), bytes.size()),
                      [&](const asio::error_code& error, std::size_t) { result = error; });
    const auto deadline = steady_now() + write_time_;
    const auto asked = stop_();
    while (!run(result, std::min(deadline, steady_now() + stop_notice)))
      if (steady_now() >= deadline || stop_() > asked)
        break;
    stuck_ = !cancel_unless(result);
    if (stuck_)
      return stop_() > asked ? failed(LinkError::Kind::Interrupted, "interrupted")
                             : failed(LinkError::Kind::Broken, takes_nothing);
    if (*result)
      return link_error(*result);
    return {};
  }

  tl::expected<Bytes, LinkError> read(Instant deadline) override {
    std::optional<asio::error_code> result;
    std::size_t size = 0;
    stream_.async_read_some(asio::buffer(buffer_),
                            [&](const asio::error_code& error, std::size_t count) {
                              result = error;
                              size = count;
                            });
    run(result, deadline);
    const auto in_time = cancel_unless(result);
    if (size > 0)
      return Bytes(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size));
    if (!in_time)
      return Bytes{};
    if (*result)
      return link_error(*result);
    return Bytes{};
  }

private:
  static constexpr auto takes_nothing = "the link no longer accepts data";

  /// Runs the operation to its end or to the deadline; whether it has ended.
  bool run(const std::optional<asio::error_code>& result, Instant deadline) {
    io_->restart();
    io_->poll();
    if (!result && deadline > steady_now()) {
      const auto until = std::chrono::steady_clock::time_point(
          std::chrono::duration_cast<std::chrono::steady_clock::duration>(
              deadline.time_since_epoch()));
      if (deadline == never)
        io_->run();
      else
        io_->run_until(until);
    }
    return result.has_value();
  }

  /// Cancels the operation unless it has ended; whether it came to its own end.
  bool cancel_unless(const std::optional<asio::error_code>& result) {
    if (result)
      return true;
    asio::error_code ignored;
    stream_.cancel(ignored);
    io_->restart();
    io_->run();
    return !result || *result != asio::error::operation_aborted;
  }

  tl::unexpected<LinkError> link_error(const asio::error_code& error) {
    // A pty whose other end is closed says EIO, a vanished radio link ECONNRESET or ETIMEDOUT.
    if (error == asio::error::eof || error.value() == EIO ||
        error == asio::error::connection_reset || error == asio::error::broken_pipe ||
        error == asio::error::timed_out || error.value() == ENODEV)
      return failed(LinkError::Kind::Closed, "the other end closed the connection");
    return failed(LinkError::Kind::Broken, error.message());
  }

  std::unique_ptr<asio::io_context> io_;
  Stream stream_;
  Duration write_time_;
  Stop stop_;
  bool stuck_ = false; ///< a write did not come to its end
  std::array<std::uint8_t, read_most> buffer_{};
};

using Opened = tl::expected<std::unique_ptr<protocol::Transport>, LinkError>;

/// The number that errno would have: sockets of Windows have numbers of their own.
inline int error_number(const asio::error_code& error) {
  if (error == asio::error::connection_refused)
    return ECONNREFUSED;
  if (error == asio::error::timed_out)
    return ETIMEDOUT;
  if (error == asio::error::host_unreachable || error == asio::error::network_unreachable)
    return EHOSTUNREACH;
  return error.default_error_condition().value();
}

/// Nothing has been sent while a link is being opened.
inline tl::unexpected<LinkError> interrupted() {
  return failed(LinkError::Kind::Interrupted, interrupted_opening);
}

/// Lets `wait` wait for short times until it is true, or until nobody waits any more.
template <class Wait>
bool wait_unless(const Stop& stop, Instant deadline, const Wait& wait) {
  while (stop() == 0 && steady_now() < deadline)
    if (wait(std::min(stop_notice, deadline - steady_now())))
      return true;
  return false;
}

/// Connects within the budget; the error is 0 for success.
template <class Socket, class Connect>
int connect_in_time(asio::io_context& io, Socket& socket, const Budgets& budgets, const Stop& stop,
                    const Connect& connect) {
  asio::error_code result = asio::error::timed_out;
  connect([&](const asio::error_code& error) { result = error; });
  io.restart();
  if (!wait_unless(stop, steady_now() + budgets.connect, [&](Duration time) {
        io.run_for(time);
        return io.stopped();
      })) {
    asio::error_code ignored;
    socket.close(ignored);
    io.run();
    return ETIMEDOUT;
  }
  return error_number(result);
}

/// Opens a serial port: raw, exclusive, flushed.
Opened open_serial(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop);

/// Opens a socket of classic Bluetooth.
Opened open_rfcomm(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop);

} // namespace orb::uploader
