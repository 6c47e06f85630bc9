#include "serve/tcp_link.h"

#include <fmt/format.h>
#include <utility>

namespace orb::serve {

using asio::ip::tcp;

tl::expected<void, IoError> TcpLink::listen(const std::string& host, int port) {
  asio::error_code error;
  tcp::resolver resolver(acceptor_.get_executor());
  const auto found = resolver.resolve(host, "0", tcp::resolver::numeric_service, error);
  if (error || found.empty())
    return tl::unexpected(
        IoError{fmt::format("cannot find the host `{}`: {}; write an address of this "
                            "machine such as 127.0.0.1",
                            host, error.message())});
  if (port > UINT16_MAX)
    return tl::unexpected(
        IoError{fmt::format("port {} is above the highest, 65535; start with a lower one", port)});
  auto endpoint = found.begin()->endpoint();
  endpoint.port(static_cast<std::uint16_t>(port));
  acceptor_.open(endpoint.protocol(), error);
  if (!error)
    acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error)
    acceptor_.bind(endpoint, error);
  if (!error)
    acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error)
    return tl::unexpected(IoError{fmt::format("cannot listen on {}:{}: {}; port 0 picks a free one",
                                              host, port, error.message())});
  return {};
}

std::string TcpLink::address() const {
  const auto place = acceptor_.local_endpoint();
  const auto host = place.address().to_string();
  return fmt::format(fmt::runtime(place.address().is_v6() ? "tcp [{}]:{}" : "tcp {}:{}"), host,
                     place.port());
}

void TcpLink::start(Door& door) {
  acceptor_.async_accept([this, &door](asio::error_code error, tcp::socket socket) {
    if (!error)
      let_in(door, std::move(socket));
    if (error != asio::error::operation_aborted)
      start(door);
  });
}

void TcpLink::let_in(Door& door, tcp::socket socket) {
  if (!door.admits())
    return; // closing the socket is the refusal
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  stream_.assign(socket.release());
  stream_.native_non_blocking(true, ignored);
  door.enter(*this);
}

} // namespace orb::serve
