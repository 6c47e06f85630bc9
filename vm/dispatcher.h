#pragma once

#include "base/bytes.h"
#include "base/time.h"

namespace orb::vm {

class Ball;

/// The API: finds packets in what a client sends, obeys them through Ball's actions with
/// Actor::Client, and answers with `Ball::send`. Ball calls it like this:
///   - `receive` with every piece of bytes, at the ball's present instant;
///   - `next_event()` and `run` for what it must do by itself (half packets that time out, power
///     notifications, soul-block messages);
///   - `on_sleep` / `on_disconnect` to drop what does not outlive them.
class Dispatcher {
public:
  void receive(ByteView bytes, Ball& ball);
  Instant next_event() const { return never; }
  void run(Instant now, Ball& ball);
  void on_disconnect(Ball& ball);
  void on_sleep(Ball& ball);
  /// The state of the battery changed (power notifications).
  void on_battery(Ball& ball);
  /// A collision was reported (shield, experience).
  void on_collision(Ball& ball);
};

} // namespace orb::vm
