#pragma once

#include "playground/engine/request.h"
#include "protocol/transport.h"

#include <optional>
#include <utility>
#include <vector>

namespace orb::playground {

/// The result of an operation on the browser's link.
struct Done {
  Instant at{}; ///< when it completed
  Bytes bytes;  ///< for a read
  std::optional<protocol::LinkError> error;
};

/// Reads the link's part of a message: `at`, and `bytes` or an `error`.
Done read_done(const ordered_json& message);

/// Replays the operations done so far, then asks for the next one.
class LogLink final : public protocol::Transport {
public:
  explicit LogLink(const std::vector<Done>& done) : done_(done) {}

  Instant now() const override { return now_; }

  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    const auto* done = next({{"write", bytes_json(bytes)}});
    return failed(done) ? tl::unexpected(error(done)) : tl::expected<void, protocol::LinkError>();
  }

  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    const auto* done = next({{"read_until", milliseconds(deadline.time_since_epoch())}});
    return failed(done) ? tl::unexpected(error(done))
                        : tl::expected<Bytes, protocol::LinkError>(done->bytes);
  }

  /// The next operation; null if the log was sufficient.
  const ordered_json& wish() const { return wish_; }

private:
  const Done* next(ordered_json wish) {
    if (at_ == done_.size()) {
      if (wish_.is_null())
        wish_ = std::move(wish);
      return nullptr;
    }
    now_ = done_[at_].at;
    return &done_[at_++];
  }
  static bool failed(const Done* done) { return done == nullptr || done->error; }
  static protocol::LinkError error(const Done* done) {
    return done == nullptr ? protocol::LinkError{protocol::LinkError::Kind::Ended, "not yet"}
                           : *done->error;
  }

  const std::vector<Done>& done_;
  std::size_t at_ = 0;
  Instant now_{};
  ordered_json wish_;
};

} // namespace orb::playground
