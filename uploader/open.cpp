// The links that the operating system gives: each is an Asio stream behind the Transport interface.

#include "spec/serial.h"
#include "uploader/ble.h"
#include "uploader/bluez.h"

#include <algorithm>
#include <array>
#include <asio.hpp>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <fmt/format.h>
#include <future>
#include <optional>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <system_error>
#include <termios.h>
#include <thread>
#include <utility>

namespace orb::uploader {
namespace {

using protocol::LinkError;

constexpr std::size_t read_most = 4096; // bytes at once
constexpr int rfcomm_protocol = 3;      // BTPROTO_RFCOMM

tl::unexpected<LinkError> failed(LinkError::Kind kind, std::string message) {
  return tl::unexpected(LinkError{kind, std::move(message)});
}

Instant steady_now() {
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

/// Whether a device is the slave of a pty. Source: Linux, admin-guide/devices.txt
bool is_pty(int handle) {
  constexpr unsigned first = 136, last = 143; // major numbers
  struct stat status {};
  return ::fstat(handle, &status) == 0 && S_ISCHR(status.st_mode) &&
         major(status.st_rdev) >= first && major(status.st_rdev) <= last;
}

/// Keeps others off. TIOCEXCL does not stop root and flock only stops those who ask: together they
/// do. On a pty TIOCEXCL would outlive its client and lock everybody out for as long as the other
/// end is open.
bool lock(int handle) {
  return ::flock(handle, LOCK_EX | LOCK_NB) == 0 &&
         (is_pty(handle) || ::ioctl(handle, TIOCEXCL) == 0);
}

/// Raw, exclusive, flushed. A line discipline would turn LF into CR LF and eat XON and XOFF.
Opened open_serial(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop) {
  auto io = std::make_unique<asio::io_context>(1);
  asio::serial_port port(*io);
  asio::error_code error;
  port.open(endpoint.path, error);
  if (error)
    return tl::unexpected(describe_open_error(endpoint, error.value()));
  const auto handle = port.native_handle();
  if (!lock(handle))
    return tl::unexpected(describe_open_error(endpoint, errno));
  termios settings{};
  if (::tcgetattr(handle, &settings) != 0)
    return tl::unexpected(describe_open_error(endpoint, errno));
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (::tcsetattr(handle, TCSANOW, &settings) != 0)
    return tl::unexpected(describe_open_error(endpoint, errno));
  port.set_option(asio::serial_port::baud_rate(spec::serial_baud_rate),
                  error); // a pty may not care
  // What waits to be sent on a pty is what the client before has said, not noise of a radio.
  ::tcflush(handle, is_pty(handle) ? TCIFLUSH : TCIOFLUSH);
  return std::make_unique<AsioTransport<asio::serial_port>>(std::move(io), std::move(port),
                                                            budgets.write, stop);
}

/// Nothing has been sent while a link is being opened.
tl::unexpected<LinkError> interrupted() {
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
  return result.value();
}

using Addresses = asio::ip::tcp::resolver::results_type;

/// The addresses of a host. A look-up can take half a minute and cannot be cancelled: where nobody
/// waits any more its thread is left to itself.
tl::expected<Addresses, LinkError> look_up(const Endpoint& endpoint, const Stop& stop) {
  std::packaged_task<Addresses()> task([host = endpoint.host, port = endpoint.port] {
    asio::io_context io(1);
    asio::error_code ignored;
    return asio::ip::tcp::resolver(io).resolve(host, std::to_string(port), ignored);
  });
  auto found = task.get_future();
  try {
    std::thread(std::move(task)).detach();
  } catch (const std::system_error& error) {
    return failed(LinkError::Kind::CannotOpen,
                  fmt::format("cannot open {}: {}", endpoint.text, error.code().message()));
  }
  if (!wait_unless(stop, never, [&](Duration time) {
        return found.wait_for(time) == std::future_status::ready;
      }))
    return interrupted();
  if (auto addresses = found.get(); !addresses.empty())
    return addresses;
  return failed(LinkError::Kind::CannotOpen,
                fmt::format("cannot open {}: no host is called `{}`; check the name", endpoint.text,
                            endpoint.host));
}

Opened open_tcp(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop) {
  using asio::ip::tcp;
  const auto addresses = look_up(endpoint, stop);
  if (!addresses)
    return tl::unexpected(addresses.error());
  auto io = std::make_unique<asio::io_context>(1);
  tcp::socket socket(*io);
  const auto result = connect_in_time(*io, socket, budgets, stop, [&](const auto& done) {
    asio::async_connect(socket, *addresses,
                        [done](const asio::error_code& e, const tcp::endpoint&) { done(e); });
  });
  if (result != 0)
    return tl::unexpected(describe_open_error(endpoint, result));
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  return std::make_unique<AsioTransport<tcp::socket>>(std::move(io), std::move(socket),
                                                      budgets.write, stop);
}

Opened open_rfcomm(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop) {
  using Protocol = asio::generic::stream_protocol;
  auto io = std::make_unique<asio::io_context>(1);
  Protocol::socket socket(*io);
  asio::error_code error;
  socket.open(Protocol(AF_BLUETOOTH, rfcomm_protocol), error);
  if (error)
    return tl::unexpected(describe_open_error(endpoint, error.value()));
  const auto address = rfcomm_socket_address(endpoint.address, endpoint.channel);
  const Protocol::endpoint target(address.data(), address.size(), rfcomm_protocol);
  const auto result = connect_in_time(*io, socket, budgets, stop, [&](const auto& done) {
    socket.async_connect(target, [done](const asio::error_code& e) { done(e); });
  });
  if (result != 0)
    return tl::unexpected(describe_open_error(endpoint, result));
  return std::make_unique<AsioTransport<Protocol::socket>>(std::move(io), std::move(socket),
                                                           budgets.write, stop);
}

Opened open_once(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop) {
  switch (endpoint.scheme) {
  case Scheme::Serial:
  case Scheme::Pty: return open_serial(endpoint, budgets, stop);
  case Scheme::Rfcomm: return open_rfcomm(endpoint, budgets, stop);
  case Scheme::Tcp: return open_tcp(endpoint, budgets, stop);
  case Scheme::Ble:
  case Scheme::Replay:
  case Scheme::Sim: break;
  }
  return failed(LinkError::Kind::CannotOpen, "the operating system has no such link");
}

} // namespace

Opened open(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop,
            const OnBleStep& on_step, Accepts accepts) {
  if (endpoint.scheme == Scheme::Ble) {
    auto opened = open_ble(make_bluez_gatt(endpoint), budgets, stop, on_step, accepts);
    if (!opened)
      return tl::unexpected(describe_open_error(endpoint, opened.error()));
    return *std::move(opened);
  }
  // Only a radio link fails now and works a moment later: the ball may be waking up.
  const auto times = endpoint.scheme == Scheme::Rfcomm ? budgets.opens : 1;
  auto opened = open_once(endpoint, budgets, stop);
  for (int time = 1; !opened && stop() == 0 && time < times; ++time) {
    wait_unless(stop, steady_now() + budgets.backoff(time), [](Duration pause) {
      std::this_thread::sleep_for(pause);
      return false;
    });
    opened = open_once(endpoint, budgets, stop);
  }
  if (!opened && stop() > 0)
    return interrupted();
  return opened;
}

} // namespace orb::uploader
