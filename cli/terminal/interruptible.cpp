#include "cli/terminal/interrupt.h"
#include "uploader/budgets.h"

#include <algorithm>
#include <chrono>

namespace orb::cli {

namespace {

/// A closed link; only its clock goes on.
class ClosedLink final : public protocol::Transport {
public:
  explicit ClosedLink(Instant now) : now_(now) {}

  Instant now() const override {
    return now_ + std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - began_);
  }
  tl::expected<void, protocol::LinkError> write(ByteView) override {
    return tl::unexpected(closed());
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant) override {
    return tl::unexpected(closed());
  }

private:
  static protocol::LinkError closed() {
    return {protocol::LinkError::Kind::Closed, "the link is closed"};
  }

  Instant now_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

} // namespace

void InterruptibleTransport::close() {
  inner_ = std::make_unique<ClosedLink>(now());
}

bool InterruptibleTransport::stop() {
  if (asked() <= seen_)
    return false;
  seen_ = asked();
  return true;
}

tl::expected<void, protocol::LinkError> InterruptibleTransport::write(ByteView bytes) {
  if (stop())
    return tl::unexpected(
        protocol::LinkError{protocol::LinkError::Kind::Interrupted, "interrupted"});
  auto written = inner_->write(bytes);
  if (!written && written.error().kind == protocol::LinkError::Kind::Interrupted)
    seen_ = asked(); // the link failed by itself
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
