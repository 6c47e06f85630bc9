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

/// Why a request has no answer.
struct NoAnswer {
  enum class Kind : std::uint8_t {
    TimedOut, ///< nothing came in time
    Link      ///< the link failed: `link` says how
  };
  Kind kind = Kind::TimedOut;
  protocol::LinkError link;
};

/// What went over the wire so far.
struct WireCounts {
  std::uint64_t packets_out = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t bytes_in = 0;
  std::uint64_t noise_in = 0;         ///< bytes that belong to no packet
  std::uint64_t damaged_in = 0;       ///< packets with a wrong checksum or without their end
  std::uint64_t arrived = 0;          ///< our packets whose answers say that they came whole
  std::uint64_t foreign_answers = 0;  ///< answers to no request of ours
  std::uint64_t echoes = 0;           ///< our own packets coming back
  std::uint64_t messages_dropped = 0; ///< async messages that nobody took in time
};

/// Whether the packet still has a right checksum after one bit of its DLEN has changed so that it
/// ends earlier: the only single-bit change that the checksum does not catch.
bool survives_shorter(const protocol::Command& command);

/// A conversation with a ball: one request in flight, each under a sequence number of its own, and
/// an inbox for what the ball sends unasked. It ends no wait later than the budgets say.
class Session {
public:
  /// `first_seq` is drawn by the caller: a stale answer should not look like one to us.
  Session(protocol::Transport& transport, const Budgets& budgets, std::uint8_t first_seq);

  /// Discards what arrives for Budgets::drain.
  tl::expected<void, NoAnswer> drain();

  /// Sends once and waits for the answer. A packet that could be mistaken after one bit error is
  /// held back until a ping has moved the sequence number on.
  tl::expected<protocol::Response, NoAnswer> exchange(spec::ApiCommand command,
                                                      const Bytes& data = {});

  /// Sends until there is an answer, at most Budgets::sends times; only for commands that do no
  /// harm twice. The answers "damaged" and "busy" count as none.
  tl::expected<protocol::Response, NoAnswer> ask(spec::ApiCommand command, const Bytes& data = {});

  /// Takes in what comes until `deadline`, or until `enough` says so.
  tl::expected<void, NoAnswer> listen(Instant deadline, const std::function<bool()>& enough = {});

  /// From now on a second answer to a command that is not harmless twice is remembered: it may mean
  /// that the command was carried out twice.
  void watch_duplicates();
  bool duplicate_seen() const { return duplicate_seen_; }

  /// The messages that came unasked, oldest first. At most 4096 wait; then the oldest are dropped.
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
  std::size_t least_payload_ = 0;       ///< of an answer "OK" to it
  std::size_t most_payload_ = 0;
  std::bitset<256> also_; ///< earlier sendings of the same ask
  std::optional<protocol::Response> answer_;
  bool once_ = false;         ///< the request in flight is not harmless twice
  std::bitset<256> answered_; ///< requests that must not be answered twice
  bool duplicate_seen_ = false;
  std::deque<protocol::Async> inbox_;
  WireCounts counts_;
};

/// Whether the state that an answer "later" speaks of passes by itself.
bool is_transient(std::uint8_t code);

/// `0Ah generic RAM access needed but it is busy`, or `2Ch, an undocumented code`.
std::string describe_code(std::uint8_t code);

} // namespace orb::uploader
