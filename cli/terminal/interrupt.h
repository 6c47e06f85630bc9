#pragma once

#include "protocol/transport.h"

#include <memory>

namespace orb::cli {

/// Turns SIGINT, SIGTERM and SIGHUP into a request to stop during its lifetime. A nested guard has
/// no effect: the outermost one counts.
class InterruptGuard {
public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// How often the user asked to stop since the outermost guard was made.
  static int asked();

private:
  bool hears_hangup_ = false;
};

/// A Transport whose waits end when the user asks to stop: the next read or write fails once with
/// Interrupted; later ones succeed, so clean-up can finish. A second request also ends that.
class InterruptibleTransport final : public protocol::Transport {
public:
  explicit InterruptibleTransport(std::unique_ptr<protocol::Transport> inner)
      : inner_(std::move(inner)) {}

  Instant now() const override { return inner_->now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

  /// Acts as if the user had asked to stop, for this link only.
  void interrupt() { ++own_; }
  /// Releases the inner transport: from now on the link is lost.
  void close();

private:
  int asked() const { return InterruptGuard::asked() + own_; }
  bool stop();

  std::unique_ptr<protocol::Transport> inner_;
  int seen_ = 0;
  int own_ = 0;
};

} // namespace orb::cli
