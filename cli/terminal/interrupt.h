#pragma once

#include "protocol/transport.h"

#include <memory>

namespace orb::cli {

/// Makes SIGINT, SIGTERM and SIGHUP a request to stop instead of a death, as long as it lives. One
/// within another changes nothing: the first one counts for all.
class InterruptGuard {
public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// How often the user asked to stop since the first guard was made.
  static int asked();

private:
  bool hears_hangup_ = false;
};

/// A Transport around a Transport whose waits end when the user asks to stop: the next read or
/// write is then the error Interrupted, once; what follows is clean-up and goes through. A second
/// request ends that too.
class InterruptibleTransport final : public protocol::Transport {
public:
  explicit InterruptibleTransport(std::unique_ptr<protocol::Transport> inner)
      : inner_(std::move(inner)) {}

  Instant now() const override { return inner_->now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override;

  /// As if the user had asked to stop, for this link alone.
  void interrupt() { ++own_; }
  /// Lets go of what is around it: from now on it is a link that is lost.
  void close();

private:
  int asked() const { return InterruptGuard::asked() + own_; }
  bool stop();

  std::unique_ptr<protocol::Transport> inner_;
  int seen_ = 0;
  int own_ = 0;
};

} // namespace orb::cli
