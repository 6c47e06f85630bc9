#pragma once

#include "base/time.h"

namespace orb::vm {

class Ball;

/// Sensor streaming (API §Set Data Streaming): samples `Ball::body()` every N steps of the control
/// system and sends the frames with `Ball::send`. The dispatcher configures it through
/// `Ball::streamer()`; Ball calls `run` at `next_event()`, after the body's step of that instant.
class Streamer {
public:
  Instant next_event() const { return never; }
  void run(Instant now, Ball& ball);
  void stop() {}
};

} // namespace orb::vm
