// Devices on Unix: serial ports, ptys, Bluetooth sockets.

#include "spec/serial.h"
#include "uploader/asio_transport.h"

#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>

namespace orb::uploader {
namespace {

constexpr int rfcomm_protocol = 3; // BTPROTO_RFCOMM

/// Returns true if the device is the slave of a pty. Source: Linux, admin-guide/devices.txt
bool is_pty(int handle) {
  constexpr unsigned first = 136, last = 143; // major numbers
  struct stat status {};
  return ::fstat(handle, &status) == 0 && S_ISCHR(status.st_mode) &&
         major(status.st_rdev) >= first && major(status.st_rdev) <= last;
}

/// Keeps other programs out. TIOCEXCL does not stop root, and flock stops only programs that ask,
/// so use both. Not TIOCEXCL on a pty: it would outlive the client and lock everybody out while the
/// other end is open.
bool lock(int handle) {
  return ::flock(handle, LOCK_EX | LOCK_NB) == 0 &&
         (is_pty(handle) || ::ioctl(handle, TIOCEXCL) == 0);
}

} // namespace

/// Disables the line discipline, which would turn LF into CR LF and consume XON and XOFF.
Opened open_serial(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop) {
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
                  error); // a pty may ignore it
  // On a pty, keep pending output: it belongs to the client before, and is not radio noise.
  ::tcflush(handle, is_pty(handle) ? TCIFLUSH : TCIOFLUSH);
  return std::make_unique<AsioTransport<asio::serial_port>>(std::move(io), std::move(port),
                                                            budgets.write, stop);
}

Opened open_rfcomm(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop) {
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

} // namespace orb::uploader
