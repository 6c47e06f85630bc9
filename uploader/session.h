#pragma once

#include "protocol/decoder.h"
#include "protocol/transport.h"
#include "uploader/budgets.h"

#include <bitset>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>

namespace orb::uploader {

/// Why a request got no answer.
struct NoAnswer {
  enum class Kind : std::uint8_t {
    TimedOut, ///< no answer in time
    Link      ///< the link failed as described by `link`
  };
  Kind kind = Kind::TimedOut;
  protocol::LinkError link;
};

/// Traffic so far.
struct WireCounts {
  std::uint64_t packets_out = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t bytes_in = 0;
  std::uint64_t noise_in = 0;         ///< bytes outside packets
  std::uint64_t damaged_in = 0;       ///< packets with a wrong checksum or without their end
  std::uint64_t arrived = 0;          ///< our packets that arrived whole, by their answers
  std::uint64_t foreign_answers = 0;  ///< answers to requests of others
  std::uint64_t echoes = 0;           ///< our own packets received back
  std::uint64_t messages_dropped = 0; ///< async messages dropped from a full inbox
};

/// Returns true if the packet still has a valid checksum after a one-bit change of DLEN that ends
/// it earlier: the only single-bit error that the checksum misses.
bool survives_shorter(const protocol::Command& command);

/// A conversation with a ball: one request at a time, each with a new sequence number, and an inbox
/// for unsolicited messages. No wait exceeds the budgets. Large because whether an answer counts
/// depends on the current request, its earlier attempts and answers that came twice.
class Session {
public:
  /// The caller draws `first_seq` at random, so that a stale answer does not look current.
  Session(protocol::Transport& transport, const Budgets& budgets, std::uint8_t first_seq);

  /// Discards what arrives for Budgets::drain.
  tl::expected<void, NoAnswer> drain();

  /// Sends once and waits for the answer. Before a packet that one bit error could disguise it
  /// sends pings, which advance the sequence number.
  tl::expected<protocol::Response, NoAnswer> exchange(spec::ApiCommand command,
                                                      const Bytes& data = {});

  /// Sends up to Budgets::sends times until answered; only for commands that are harmless to
  /// repeat. The answers "damaged" and "busy" count as none.
  tl::expected<protocol::Response, NoAnswer> ask(spec::ApiCommand command, const Bytes& data = {});

  /// Processes input until `deadline`, or until `enough` returns true.
  tl::expected<void, NoAnswer> listen(Instant deadline, const std::function<bool()>& enough = {});

  /// Starts to detect second answers to commands that are not harmless to repeat: such a command
  /// may have been executed twice.
  void watch_duplicates();
  bool duplicate_seen() const { return duplicate_seen_; }

  /// Unsolicited messages, oldest first. At most 4096 are kept; the oldest are dropped.
  std::deque<protocol::Async>& inbox() { return inbox_; }

  std::uint8_t next_seq() const { return next_seq_; }
  const WireCounts& counts() const { return counts_; }
  Instant now() const { return transport_.now(); }
  const Budgets& budgets() const { return budgets_; }

private:
  tl::expected<void, NoAnswer> send(spec::ApiCommand command, const Bytes& data);
  tl::expected<std::optional<protocol::Response>, NoAnswer> receive(Instant deadline);
  void take_in();
  void take_in(const protocol::Item& item);
  bool awaited(const protocol::Item& item) const;

  protocol::Transport& transport_;
  Budgets budgets_;
  protocol::Decoder decoder_{protocol::Direction::FromBall};
  std::uint8_t next_seq_;
  Bytes last_sent_;
  std::optional<std::uint8_t> current_; ///< the request in flight
  std::size_t least_payload_ = 0;       ///< payload limits of an answer "OK" to it
  std::size_t most_payload_ = 0;
  std::bitset<256> also_; ///< sequence numbers of earlier attempts of the same ask
  std::optional<protocol::Response> answer_;
  bool once_ = false;         ///< the request in flight must not be repeated
  std::bitset<256> answered_; ///< requests that must not be answered twice
  bool duplicate_seen_ = false;
  std::deque<protocol::Async> inbox_;
  WireCounts counts_;
};

/// Returns true if the state behind an answer "later" passes by itself.
bool is_transient(std::uint8_t code);

/// Returns `0Ah generic RAM access needed but it is busy`, or `2Ch, an undocumented code`.
std::string describe_code(std::uint8_t code);

} // namespace orb::uploader
