#include "cli/terminal/interrupt.h"
#include "uploader/budgets.h"

#include <algorithm>

namespace orb::cli {

bool InterruptibleTransport::stop() {
  const int asked = InterruptGuard::asked();
  if (asked <= seen_)
    return false;
  seen_ = asked;
  return true;
}

tl::expected<void, protocol::LinkError> InterruptibleTransport::write(ByteView bytes) {
  if (stop())
    return tl::unexpected(
        protocol::LinkError{protocol::LinkError::Kind::Interrupted, "interrupted"});
  auto written = inner_->write(bytes);
  if (!written && written.error().kind == protocol::LinkError::Kind::Interrupted)
    seen_ = InterruptGuard::asked(); // it noticed by itself
  return written;
}

tl::expected<Bytes, protocol::LinkError> InterruptibleTransport::read(Instant deadline) {
  while (true) {
    if (stop())
      return tl::unexpected(
          protocol::LinkError{protocol::LinkError::Kind::Interrupted, "interrupted"});
    const auto slice = std::min(deadline, now() + uploader::stop_notice);
    auto read = inner_->read(slice);
    if (!read || !read->empty() || now() >= deadline)
      return read;
  }
}

} // namespace orb::cli
