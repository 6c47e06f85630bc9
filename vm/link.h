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

/// How packets leave. Paced: one after the other at the speed of the wire. Unpaced: at once, for a
/// server whose link is real; programs that print are slowed down by the wire all the same.
enum class Wire : std::uint8_t { Paced, Unpaced };

/// What the ball sends to its client, on its way over a wire of 11 520 bytes a second: a queue of
/// packets, each with the instant at which its last byte has left. Without a client nothing is
/// sent.
class Link {
public:
  explicit Link(Wire wire) : wire_(wire) {}

  bool connected() const { return connected_; }
  void connect() { connected_ = true; }
  /// The client is gone, and with it what waited to leave.
  void disconnect();
  /// The ball lets its client go; what waits still leaves.
  void close() { connected_ = false; }

  void send(const protocol::Response& response, Instant now);
  /// Under congestion messages that are not vital are dropped (docs/ball.md).
  void send(const protocol::Async& async, Instant now);
  /// Sends what a program prints; where the queue is too full nothing is sent, and the program may
  /// try again at the instant that is returned.
  std::optional<Instant> print(std::string_view text, Instant now);
  /// Messages wait from here to release_messages(), so that an answer can go before them.
  void hold_messages() { holding_ = true; }
  void release_messages(Instant now);

  /// Packets sent, and messages dropped under congestion.
  std::uint32_t sent() const { return sent_; }
  std::uint32_t dropped() const { return dropped_; }
  void clear_counters() { sent_ = dropped_ = 0; }

  /// The millisecond counter that stamps messages; 0 at power-on. Source: API §Assign Time Value.
  std::uint32_t clock_ms(Instant now) const;
  void set_clock_ms(std::uint32_t value, Instant now);

  /// The bytes that have not left at `now`.
  std::size_t waiting(Instant now) const;
  /// When no more than `bytes` will be waiting; `now` where that is so already.
  Instant drained_to(std::size_t bytes, Instant now) const;
  /// The first packet, when it has left at `now`.
  std::optional<Bytes> take(Instant now);
  /// When the next packet has left; `never` when there is none.
  Instant next_event() const { return packets_.empty() ? never : packets_.front().left; }

private:
  /// What a packet is to the wire: an unpaced one does not hold up answers.
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
  Instant idle_at_{}; ///< when all that was pushed has left
  std::uint32_t sent_ = 0;
  std::uint32_t dropped_ = 0;
  Duration clock_offset_{};
};

} // namespace orb::vm
