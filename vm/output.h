#pragma once

#include "base/bytes.h"
#include "base/time.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace orb::vm {

/// How packets leave. Paced: one behind the other at the speed of the wire. Unpaced: at once, for a
/// server whose link is real; programs that print are slowed down by the wire all the same.
enum class Wire : std::uint8_t { Paced, Unpaced };

/// What the ball sends, on its way over a wire of 11 520 bytes a second: a queue of packets, each
/// with the instant at which its last byte has left.
class Output {
public:
  explicit Output(Wire wire) : wire_(wire) {}

  /// What a packet is to the wire: an unpaced one does not hold up answers.
  enum class Kind : std::uint8_t { Answer, Message };

  /// Puts a packet behind the others.
  void push(Bytes packet, Instant now, Kind kind);
  /// The bytes that have not left at `now`.
  std::size_t waiting(Instant now) const;
  /// When no more than `bytes` will be waiting; `now` where that is so already.
  Instant drained_to(std::size_t bytes, Instant now) const;
  /// The first packet, when it has left at `now`.
  std::optional<Bytes> take(Instant now);
  /// When the next packet has left; `never` when there is none.
  Instant next_event() const { return packets_.empty() ? never : packets_.front().left; }
  void clear();

private:
  struct Packet {
    Instant left;
    Bytes bytes;
  };
  Wire wire_;
  std::deque<Packet> packets_;
  Instant idle_at_{}; ///< when all that was pushed has left
};

} // namespace orb::vm
