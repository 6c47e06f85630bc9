#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/packet.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace orb::vm {

/// How packets leave. Paced: one after another at the speed of the wire. Unpaced: at once, for a
/// server with a real link; printing programs still wait for the simulated wire.
enum class Wire : std::uint8_t { Paced, Unpaced };

/// Output to the client over a wire of 11 520 bytes a second: a queue of packets, each with the
/// instant at which its last byte leaves. Without a client nothing is sent.
class Link {
public:
  explicit Link(Wire wire) : wire_(wire) {}

  bool connected() const { return connected_; }
  void connect() { connected_ = true; }
  /// The client disconnects; drops queued packets.
  void disconnect();
  /// The ball disconnects; queued packets still leave.
  void close() { connected_ = false; }

  void send(const protocol::Response& response, Instant now);
  /// Drops messages that are not vital if the wire is congested (docs/using/ball.md).
  void send(const protocol::Async& async, Instant now);
  /// Sends printed text. If the queue is too full it sends nothing and returns when to try again.
  std::optional<Instant> print(std::string_view text, Instant now);
  /// Holds messages back until release_messages(), so that the answer leaves first.
  void hold_messages() { holding_ = true; }
  void release_messages(Instant now);

  /// Packets sent, and messages dropped because of congestion.
  std::uint32_t sent() const { return sent_; }
  std::uint32_t dropped() const { return dropped_; }
  void clear_counters() { sent_ = dropped_ = 0; }

  /// The millisecond counter that stamps messages; 0 at power-on. Source: API §Assign Time Value.
  std::uint32_t clock_ms(Instant now) const;
  void set_clock_ms(std::uint32_t value, Instant now);

  /// The number of bytes still queued at `now`.
  std::size_t waiting(Instant now) const;
  /// When at most `bytes` are queued; `now` if that is already so.
  Instant drained_to(std::size_t bytes, Instant now) const;
  /// Returns the first packet if it has left by `now`.
  std::optional<Bytes> take(Instant now);
  /// When the next packet has left; `never` if none is queued.
  Instant next_event() const { return packets_.empty() ? never : packets_.front().left; }

private:
  /// In unpaced mode only messages occupy the wire, so that they do not delay answers.
  enum class Kind : std::uint8_t { Answer, Message };
  struct Packet {
    Instant left;
    Bytes bytes;
  };
  void push(Bytes packet, Instant now, Kind kind);

  Wire wire_;
  bool connected_ = false;
  bool holding_ = false;
  std::vector<protocol::Async> held_;
  std::deque<Packet> packets_;
  Instant idle_at_{}; ///< when everything queued has left
  std::uint32_t sent_ = 0;
  std::uint32_t dropped_ = 0;
  Duration clock_offset_{};
};

} // namespace orb::vm
