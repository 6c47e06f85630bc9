#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/packet.h"
#include "vm/body/body.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

/// Sensor streaming: samples the body every N steps of the control system, after the step of that
/// instant, and makes messages of the frames. Source: API §Set Data Streaming.
class Streamer {
public:
  struct Request {
    std::uint32_t divisor = 1;  ///< N: every how many steps of the control system
    std::uint32_t frames = 1;   ///< M: per packet
    std::uint64_t mask = 0;     ///< of spec::streams
    std::uint32_t packets = 0;  ///< how many packets; 0 without end
    double accelerometer_g = 8; ///< where the accelerometer saturates
  };

  /// Whether a packet of the request fits a message.
  static bool fits(const Request& request);

  /// Streams from now on, in place of what was streamed before. A mask without sources stops.
  void start(const Request& request, Instant now);
  void stop() { next_ = never; }

  Instant next_event() const { return next_; }
  /// Takes a sample, where it is time; the message that is full then.
  std::optional<protocol::Async> run(Instant now, const Body& body);

private:
  Request request_;
  Instant next_ = never;
  std::uint32_t collected_ = 0; ///< frames in data_
  std::uint32_t sent_ = 0;      ///< packets
  Bytes data_;
};

} // namespace orb::vm
