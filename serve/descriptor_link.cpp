#include "serve/descriptor_link.h"

#include "serve/other_end.h"

#include <unistd.h>

namespace orb::serve {

void DescriptorLink::wait(Ready ready, std::function<void()> handler) {
  using Stream = asio::posix::stream_descriptor;
  stream_.async_wait(ready == Ready::Read ? Stream::wait_read : Stream::wait_write,
                     [handler = std::move(handler)](asio::error_code error) {
                       if (error != asio::error::operation_aborted)
                         handler();
                     });
}

ssize_t DescriptorLink::read(std::span<std::uint8_t> buffer) {
  return ::read(stream_.native_handle(), buffer.data(), buffer.size());
}

ssize_t DescriptorLink::write(ByteView bytes) {
  return ::write(stream_.native_handle(), bytes.data(), bytes.size());
}

bool DescriptorLink::client_left() {
  return other_end_left(stream_.native_handle());
}

} // namespace orb::serve
