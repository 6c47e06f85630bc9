// Devices on Windows: COM ports. A paired ball has one.

#include "spec/serial.h"
#include "uploader/asio_transport.h"

#include <windows.h>

namespace orb::uploader {
namespace {

/// Returns the name by which Windows opens a port of any number.
std::string full_name(const std::string& path) {
  constexpr std::string_view device = R"(\\.\)";
  return path.starts_with(device) ? path : std::string(device) + path;
}

} // namespace

/// Windows opens a port for one program only, and Asio sets it to untranslated bytes.
Opened open_serial(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop) {
  if (endpoint.scheme == Scheme::Pty)
    return tl::unexpected(describe_open_error(endpoint, ENOENT));
  auto io = std::make_unique<asio::io_context>(1);
  asio::serial_port port(*io);
  asio::error_code error;
  port.open(full_name(endpoint.path), error);
  if (error)
    return tl::unexpected(describe_open_error(endpoint, error_number(error)));
  using Port = asio::serial_port;
  port.set_option(Port::baud_rate(spec::serial_baud_rate), error);
  port.set_option(Port::character_size(8), error);
  port.set_option(Port::parity(Port::parity::none), error);
  port.set_option(Port::stop_bits(Port::stop_bits::one), error);
  port.set_option(Port::flow_control(Port::flow_control::none), error); // a radio has none of these
  ::PurgeComm(port.native_handle(), PURGE_RXCLEAR | PURGE_TXCLEAR);
  return std::make_unique<AsioTransport<asio::serial_port>>(std::move(io), std::move(port),
                                                            budgets.write, stop);
}

Opened open_rfcomm(const Endpoint& endpoint, const Budgets&, const StopRequests&) {
  return tl::unexpected(describe_open_error(endpoint, EAFNOSUPPORT));
}

} // namespace orb::uploader
