#pragma once

#include "vm/ball.h"
#include "vm/observer.h"

namespace orb::serve {

/// Sees what a served ball does. Times are those of the ball since the first start.
class Spectator : public vm::Observer {
public:
  /// The ball is there, new or again after a reset; it lives until the next call or on_end().
  virtual void on_begin(Instant at, const vm::Ball& ball) = 0;
  virtual void on_end(Instant at) = 0;
  /// Nobody cares any more: the ball need not be served on.
  virtual bool has_enough() const { return false; }
};

} // namespace orb::serve
