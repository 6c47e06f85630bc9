#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/packet.h"
#include "vm/body/body.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

/// Sensor streaming: samples the body every N steps of the control system, after the step of that
/// instant, and packs the frames into messages. Source: API §Set Data Streaming.
class Streamer {
public:
  struct Request {
    std::uint32_t divisor = 1;  ///< N: control-system steps per sample
    std::uint32_t frames = 1;   ///< M: frames per packet
    std::uint64_t mask = 0;     ///< bits of spec::streams
    std::uint32_t packets = 0;  ///< number of packets; 0: endless
    double accelerometer_g = 8; ///< range at which the accelerometer saturates
  };

  /// Returns true if a packet of the request fits a message.
  static bool fits(const Request& request);

  /// Starts a stream now and replaces the previous one. A mask without sources stops streaming.
  void start(const Request& request, Instant now);
  void stop() { next_ = never; }

  Instant next_event() const { return next_; }
  /// Takes a sample if one is due. Returns the message if the sample fills it.
  std::optional<protocol::Async> run(Instant now, const Body& body);

private:
  Request request_;
  Instant next_ = never;
  std::uint32_t collected_ = 0; ///< frames in data_
  std::uint32_t sent_ = 0;      ///< packets
  Bytes data_;
};

} // namespace orb::vm
