#include "serve/link.h"

#include <poll.h>
#include <unistd.h>

namespace orb::serve {

void Link::wait(Ready ready, std::function<void()> handler) {
  stream_.async_wait(ready, [handler = std::move(handler)](asio::error_code error) {
    if (error != asio::error::operation_aborted)
      handler();
  });
}

ssize_t Link::read(std::span<std::uint8_t> buffer) {
  return ::read(stream_.native_handle(), buffer.data(), buffer.size());
}

ssize_t Link::write(ByteView bytes) {
  return ::write(stream_.native_handle(), bytes.data(), bytes.size());
}

bool Link::client_left() {
  pollfd query{stream_.native_handle(), POLLRDHUP, 0}; // POLLHUP comes unasked
  return ::poll(&query, 1, 0) > 0;
}

} // namespace orb::serve
