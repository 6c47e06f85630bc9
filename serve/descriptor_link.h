#pragma once

#include "serve/link.h"

#include <asio/posix/stream_descriptor.hpp>

namespace orb::serve {

/// A link over a Unix descriptor: the master of a pty, a socket.
class DescriptorLink : public Link {
public:
  explicit DescriptorLink(asio::io_context& io) : stream_(io) {}

  void wait(Ready ready, std::function<void()> handler) override;
  ssize_t read(std::span<std::uint8_t> buffer) override;
  ssize_t write(ByteView bytes) override;
  bool client_left() override;

protected:
  asio::posix::stream_descriptor stream_;
};

} // namespace orb::serve
