#pragma once

#include "base/io_error.h"
#include "serve/link.h"

#include <asio/ip/tcp.hpp>
#include <tl/expected.hpp>

namespace orb::serve {

/// A TCP port. Refuses a client while another one is connected.
class TcpLink final : public Link {
public:
  explicit TcpLink(asio::io_context& io) : socket_(io), acceptor_(io) {}

  /// Listens on a port of this machine; 0 picks a free one.
  tl::expected<void, IoError> listen(const std::string& host, int port);

  /// Returns true if other machines can reach it.
  bool is_exposed() const { return !acceptor_.local_endpoint().address().is_loopback(); }

  std::string address() const override;
  void start(Door& door) override;
  void hang_up() override { socket_.close(); }
  bool can_hang_up() const override { return true; }
  void wait(Ready ready, std::function<void()> handler) override;
  ssize_t read(std::span<std::uint8_t> buffer) override;
  ssize_t write(ByteView bytes) override;
  bool client_left() override;

private:
  void let_in(Door& door, asio::ip::tcp::socket socket);

  asio::ip::tcp::socket socket_; ///< of the client
  asio::ip::tcp::acceptor acceptor_;
};

} // namespace orb::serve
