#pragma once

#include "base/bytes.h"
#include "base/time.h"

#include <deque>
#include <vector>

namespace orb::serve {

/// Decides when packets leave for a client that takes one packet from each read: answers at once,
/// messages at a distance from the packet before them (docs/protocol.md). Its time is the client's.
class PacketSpacer {
public:
  void add_answer(Bytes packet) { answers_.push_back(std::move(packet)); }
  void add_message(Bytes packet, Instant now) { messages_.push_back({std::move(packet), now}); }
  /// Lets everything leave without a distance, answers first.
  void hurry();
  /// What leaves at `now`: a write each.
  std::vector<Bytes> take(Instant now);
  /// When take() gives the next message; `never` without one.
  Instant next_due() const;
  bool has_messages() const { return !messages_.empty(); }
  void clear();

private:
  struct Message {
    Bytes bytes;
    Instant since;
  };

  void release_answers();

  std::vector<Bytes> ready_;
  std::vector<Bytes> answers_;
  std::deque<Message> messages_;
  Instant message_at_{}; ///< before which no message leaves
};

} // namespace orb::serve
