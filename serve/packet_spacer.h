#pragma once

#include "base/bytes.h"
#include "base/time.h"

#include <deque>
#include <vector>

namespace orb::serve {

/// Spaces packets for clients that parse one packet per read: answers leave at once, messages at a
/// distance from the packet before (docs/reference/protocol.md). Times are the client's.
class PacketSpacer {
public:
  void add_answer(Bytes packet) { answers_.push_back(std::move(packet)); }
  void add_message(Bytes packet, Instant now) { messages_.push_back({std::move(packet), now}); }
  /// Drops the distances: everything leaves, answers first.
  void hurry();
  /// Returns what leaves at `now`, one entry per write.
  std::vector<Bytes> take(Instant now);
  /// When the next message leaves; `never` if none waits.
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
  Instant message_at_{}; ///< no message leaves earlier
};

} // namespace orb::serve
