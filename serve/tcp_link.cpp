#include "serve/tcp_link.h"

#include "serve/other_end.h"

#include <asio/buffer.hpp>
#include <cerrno>
#include <fmt/format.h>
#include <utility>

namespace orb::serve {

using asio::ip::tcp;

namespace {

/// Converts a result to that of read(2) and write(2).
ssize_t result(std::size_t size, const asio::error_code& error) {
  if (!error || error == asio::error::eof)
    return static_cast<ssize_t>(size);
  errno = error == asio::error::would_block ? EAGAIN : error.default_error_condition().value();
  return -1;
}

} // namespace

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
    return; // closing the socket refuses the client
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  socket_ = std::move(socket);
  socket_.non_blocking(true, ignored);
  door.enter(*this);
}

void TcpLink::wait(Ready ready, std::function<void()> handler) {
  socket_.async_wait(ready == Ready::Read ? tcp::socket::wait_read : tcp::socket::wait_write,
                     [handler = std::move(handler)](asio::error_code error) {
                       if (error != asio::error::operation_aborted)
                         handler();
                     });
}

ssize_t TcpLink::read(std::span<std::uint8_t> buffer) {
  asio::error_code error;
  const auto size = socket_.read_some(asio::buffer(buffer.data(), buffer.size()), error);
  return result(size, error);
}

ssize_t TcpLink::write(ByteView bytes) {
  asio::error_code error;
  const auto size = socket_.write_some(asio::buffer(bytes.data(), bytes.size()), error);
  return result(size, error);
}

bool TcpLink::client_left() {
  return other_end_left(static_cast<int>(socket_.native_handle()));
}

} // namespace orb::serve
