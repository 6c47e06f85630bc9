#pragma once

#include "uploader/endpoint.h"

#include <algorithm>
#include <asio.hpp>
#include <cerrno>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

// Shared by the links of an operating system: an Asio stream behind the Transport interface.

namespace orb::uploader {

using protocol::LinkError;

inline constexpr std::size_t read_most = 4096; // bytes at once
inline constexpr std::chrono::milliseconds cancel_time{
    2000}; // limit for cancelling an operation, which normally takes no time
inline tl::unexpected<LinkError> failed(LinkError::Kind kind, std::string message) {
  return tl::unexpected(LinkError{kind, std::move(message)});
}

inline Instant steady_now() {
  return Instant(
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

/// Keeps an object whose destructor would wait for an operation that never ends.
inline void keep_forever(std::unique_ptr<asio::io_context> io) {
  static std::mutex mutex;
  static auto* const kept = new std::vector<std::unique_ptr<asio::io_context>>;
  const std::lock_guard lock(mutex);
  kept->push_back(std::move(io));
}

/// An Asio stream with deadlines. Runs one operation at a time and cancels an unfinished one. If
/// the system does not release it, the link is broken, and memory the operation may still touch is
/// kept alive.
template <class Stream>
class AsioTransport final : public protocol::Transport {
public:
  AsioTransport(std::unique_ptr<asio::io_context> io, Stream stream, Duration write_time,
                StopRequests stop)
      : io_(std::move(io)), stream_(std::move(stream)), write_time_(write_time),
        stop_(std::move(stop)) {}
  AsioTransport(const AsioTransport&) = delete;
  AsioTransport& operator=(const AsioTransport&) = delete;
  ~AsioTransport() override {
    if (lost_)
      keep_forever(std::move(io_));
  }

  Instant now() const override { return steady_now(); }

  tl::expected<void, LinkError> write(ByteView bytes) override {
    if (stuck_ || lost_) // the stream is in the middle of a packet
      return failed(LinkError::Kind::Broken, takes_nothing);
    const auto operation = std::make_shared<Operation>();
    operation->bytes.assign(bytes.begin(), bytes.end());
    asio::async_write(
        stream_, asio::buffer(operation->bytes),
        [operation](const asio::error_code& error, std::size_t) { operation->result = error; });
    const auto deadline = steady_now() + write_time_;
    const auto asked = stop_();
    while (!run(*operation, std::min(deadline, steady_now() + stop_notice)))
      if (steady_now() >= deadline || stop_() > asked)
        break;
    stuck_ = !cancel_unless(*operation);
    if (stuck_)
      return stop_() > asked ? failed(LinkError::Kind::Interrupted, "interrupted")
                             : failed(LinkError::Kind::Broken, takes_nothing);
    if (*operation->result)
      return link_error(*operation->result);
    return {};
  }

  tl::expected<Bytes, LinkError> read(Instant deadline) override {
    if (lost_)
      return failed(LinkError::Kind::Broken, not_let_go);
    const auto operation = std::make_shared<Operation>();
    operation->bytes.resize(read_most);
    stream_.async_read_some(asio::buffer(operation->bytes),
                            [operation](const asio::error_code& error, std::size_t count) {
                              operation->result = error;
                              operation->size = count;
                            });
    run(*operation, deadline);
    const auto in_time = cancel_unless(*operation);
    if (lost_)
      return failed(LinkError::Kind::Broken, not_let_go);
    if (operation->size > 0) {
      operation->bytes.resize(operation->size);
      return std::move(operation->bytes);
    }
    if (!in_time)
      return Bytes{};
    if (*operation->result)
      return link_error(*operation->result);
    return Bytes{};
  }

private:
  static constexpr auto takes_nothing = "the link no longer accepts data";
  static constexpr auto not_let_go = "the system does not release the link";

  /// State used by an operation, which may end after the wait for it has.
  struct Operation {
    std::optional<asio::error_code> result;
    std::size_t size = 0;
    Bytes bytes;
  };

  /// Runs the operation until it ends or the deadline passes. Returns true if it has ended.
  bool run(const Operation& operation, Instant deadline) {
    io_->restart();
    io_->poll();
    if (!operation.result && deadline > steady_now()) {
      const auto until = std::chrono::steady_clock::time_point(
          std::chrono::duration_cast<std::chrono::steady_clock::duration>(
              deadline.time_since_epoch()));
      if (deadline == never)
        io_->run();
      else
        io_->run_until(until);
    }
    return operation.result.has_value();
  }

  /// Cancels the operation unless it has ended. Returns true if it ended by itself.
  bool cancel_unless(const Operation& operation) {
    if (operation.result)
      return true;
    asio::error_code ignored;
    stream_.cancel(ignored);
    io_->restart();
    io_->run_for(cancel_time);
    lost_ = !operation.result;
    return !lost_ && *operation.result != asio::error::operation_aborted;
  }

  tl::unexpected<LinkError> link_error(const asio::error_code& error) {
    // A pty whose other end is closed reports EIO, a vanished radio link ECONNRESET or ETIMEDOUT.
    if (error == asio::error::eof || error.value() == EIO ||
        error == asio::error::connection_reset || error == asio::error::broken_pipe ||
        error == asio::error::timed_out || error.value() == ENODEV)
      return failed(LinkError::Kind::Closed, "the other end closed the connection");
    return failed(LinkError::Kind::Broken, error.message());
  }

  std::unique_ptr<asio::io_context> io_;
  Stream stream_;
  Duration write_time_;
  StopRequests stop_;
  bool stuck_ = false; ///< a write did not finish
  bool lost_ = false;  ///< an operation cannot be cancelled
};

using Opened = tl::expected<std::unique_ptr<protocol::Transport>, LinkError>;

/// Returns the number that errno would have: Windows sockets use other numbers.
inline int error_number(const asio::error_code& error) {
  if (error == asio::error::connection_refused)
    return ECONNREFUSED;
  if (error == asio::error::timed_out)
    return ETIMEDOUT;
  if (error == asio::error::host_unreachable || error == asio::error::network_unreachable)
    return EHOSTUNREACH;
  return error.default_error_condition().value();
}

/// The link was not yet open, so nothing has been sent.
inline tl::unexpected<LinkError> interrupted() {
  return failed(LinkError::Kind::Interrupted, interrupted_opening);
}

/// Calls `wait` with short times. Returns true once it does; false if the deadline passes or a stop
/// is requested.
template <class Wait>
bool wait_unless(const StopRequests& stop, Instant deadline, const Wait& wait) {
  while (stop() == 0 && steady_now() < deadline)
    if (wait(std::min(stop_notice, deadline - steady_now())))
      return true;
  return false;
}

/// Connects within the budget. Returns 0 or an error number.
template <class Socket, class Connect>
int connect_in_time(asio::io_context& io, Socket& socket, const Budgets& budgets,
                    const StopRequests& stop, const Connect& connect) {
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
Opened open_serial(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop);

/// Opens a classic Bluetooth socket.
Opened open_rfcomm(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop);

} // namespace orb::uploader
