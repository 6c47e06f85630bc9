// Opens links of all kinds.

#include "uploader/asio_transport.h"
#include "uploader/ble.h"
#include "uploader/bluez.h"

#include <asio.hpp>
#include <fmt/format.h>
#include <future>
#include <system_error>
#include <thread>
#include <utility>

namespace orb::uploader {
namespace {

using Addresses = asio::ip::tcp::resolver::results_type;

/// Resolves a host. A look-up can take half a minute and cannot be cancelled, so a stop abandons
/// its thread.
tl::expected<Addresses, LinkError> look_up(const Endpoint& endpoint, const StopRequests& stop) {
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
                fmt::format("cannot open {}: there is no host named `{}`; check the name",
                            endpoint.text, endpoint.host));
}

Opened open_tcp(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop) {
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

Opened open_once(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop) {
  switch (endpoint.scheme) {
  case Scheme::Serial:
  case Scheme::Pty: return open_serial(endpoint, budgets, stop);
  case Scheme::Rfcomm: return open_rfcomm(endpoint, budgets, stop);
  case Scheme::Tcp: return open_tcp(endpoint, budgets, stop);
  case Scheme::Ble:
  case Scheme::Replay:
  case Scheme::Sim: break;
  }
  return failed(LinkError::Kind::CannotOpen,
                "the operating system does not support this kind of link");
}

} // namespace

Opened open(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop,
            const OnBleStep& on_step, const OnBlePeer& on_peer) {
  if (endpoint.scheme == Scheme::Ble) {
    auto opened = open_ble(make_bluez_gatt(endpoint), budgets, stop, on_step, on_peer);
    if (!opened)
      return tl::unexpected(describe_open_error(endpoint, opened.error()));
    return *std::move(opened);
  }
  // Only a radio link can fail now and work a moment later: the ball may be waking up.
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
