#pragma once

#include "protocol/decoder.h"
#include "vm/ball.h"
#include "vm/common/observer.h"

namespace orb::serve {

/// Observes a served ball. Times are those of the ball since the first start.
class Spectator : public vm::Observer {
public:
  /// A ball was created, at the start or by a reset. It lives until the next call or on_end().
  virtual void on_begin(Instant at, const vm::Ball& ball) = 0;
  virtual void on_end(Instant at) = 0;
  /// Returns true to stop serving the ball.
  virtual bool has_enough() const { return false; }
};

/// Observes the bytes between a served ball and its clients. Times are those of a Spectator.
class Witness {
public:
  virtual ~Witness() = default;
  virtual void on_client(Instant at) = 0;
  virtual void on_bytes(Instant at, protocol::Direction direction, ByteView bytes) = 0;
  virtual void on_parting(Instant at) = 0;
};

} // namespace orb::serve
