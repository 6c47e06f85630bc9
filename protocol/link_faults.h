#pragma once

#include "base/random.h"
#include "protocol/decoder.h"
#include "protocol/packet_v2.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace orb::protocol {

/// Faults of a link. Rates are probabilities per packet and direction. All random numbers come from
/// `seed`, so equal traffic suffers equal faults.
struct FaultPlan {
  double drop = 0;        ///< the packet is lost
  double flip = 0;        ///< one bit of the packet is inverted, start bytes included
  double dup = 0;         ///< an answer arrives twice
  double dup_request = 0; ///< a command arrives twice
  double storm = 0;       ///< a burst of async messages precedes an answer
  Duration delay_least{};
  Duration delay_most{};   ///< upper limit of a uniform delay; packets never overtake each other
  bool split = false;      ///< packets arrive in pieces of random size
  bool merge = false;      ///< bytes arrive in lumps, every 20 ms
  std::uint32_t stale = 0; ///< old answers and stray bytes waiting when the link opens
  std::optional<std::uint64_t> cut;        ///< the link breaks after this many bytes to the ball
  std::optional<std::uint64_t> cut_answer; ///< … or after this many bytes from the ball
  std::optional<std::uint64_t> flip_at;    ///< inverts this bit of the stream to the ball, once
  std::optional<std::uint64_t> flip_answer_at; ///< … of the stream from the ball
  std::uint64_t seed = 1;
};

/// Parses `drop=1%,flip=0.1%,dup=1%,delay=50..300ms,split,cut@1234,seed=7`. The error is a sentence
/// that names the wrong word and lists the valid ones.
tl::expected<FaultPlan, std::string> parse_fault_plan(std::string_view text);

/// Returns the plan in the notation of parse_fault_plan; `none` for a plan without faults.
std::string to_string(const FaultPlan& plan);

/// Applies a plan to two streams of bytes. It is not a link: its owner pushes the bytes sent and
/// takes those that are due.
class FaultPipe {
public:
  explicit FaultPipe(const FaultPlan& plan, spec::Packets packets = spec::Packets::V1);

  /// Sends bytes at `now`. A packet may be split over several pushes.
  void push(Direction direction, ByteView bytes, Instant now);

  /// Returns the next piece that has arrived by `now`; empty if there is none.
  Bytes take(Direction direction, Instant now);

  /// When take() has more to return; `never` if it needs a push first.
  Instant next_due() const;

  /// Returns true once the plan has cut the link: nothing passes any more.
  bool cut() const { return cut_; }

  /// Reopens the link: bytes in transit are lost, and a cut does not happen again.
  void reconnect(Instant now);

private:
  struct Piece {
    Instant due;
    Bytes bytes;
  };
  struct Side {
    Side(Direction which, spec::Packets packets);
    Direction direction;
    std::variant<Decoder, DecoderV2> decoder;
    Instant held_until = never; ///< when the first part of a packet is passed on alone
    std::deque<Piece> pieces;
    Instant last_due{};
    std::uint64_t bits_in = 0;
    std::uint64_t bytes_out = 0;
  };

  Side& side(Direction direction);
  void find_packets(Side& side, Instant now);
  void pass_item(Side& side, const Item& item, Instant now);
  void pass_item(Side& side, const ItemV2& item, Instant now);
  enum class What : std::uint8_t { Request, Answer, Message };
  void pass_packet(Side& side, ByteView bytes, What what, Instant now);
  void damage_and_queue(Side& side, Bytes packet, Instant now);
  void queue(Side& side, ByteView bytes, Instant now);
  void queue_storm(Side& side, Instant now);
  void queue_stale(Instant now);

  Bytes message();
  Bytes old_answer();

  FaultPlan plan_;
  spec::Packets packets_;
  Random random_;
  Side to_ball_{Direction::ToBall, packets_};
  Side from_ball_{Direction::FromBall, packets_};
  bool cut_ = false;
};

/// A Transport that passes another one through a FaultPipe.
class FaultTransport : public Transport {
public:
  FaultTransport(std::unique_ptr<Transport> inner, const FaultPlan& plan,
                 spec::Packets packets = spec::Packets::V1);

  Instant now() const override { return inner_->now(); }
  tl::expected<void, LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, LinkError> read(Instant deadline) override;

private:
  tl::expected<void, LinkError> deliver();

  std::unique_ptr<Transport> inner_;
  FaultPipe pipe_;
};

} // namespace orb::protocol
