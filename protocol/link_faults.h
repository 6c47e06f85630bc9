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

/// What a bad link does to the bytes. Rates are probabilities per packet and direction; every draw
/// comes from `seed`, so a plan does the same to the same traffic every time.
struct FaultPlan {
  double drop = 0;        ///< the packet vanishes
  double flip = 0;        ///< one bit of the packet is inverted, start bytes included
  double dup = 0;         ///< an answer arrives twice
  double dup_request = 0; ///< a command arrives twice
  double storm = 0;       ///< a burst of async messages goes before an answer
  Duration delay_least{};
  Duration delay_most{};   ///< packets are late by a uniform draw, and never overtake each other
  bool split = false;      ///< packets arrive in pieces of random size
  bool merge = false;      ///< bytes arrive in lumps, every 20 ms
  std::uint32_t stale = 0; ///< old answers and stray bytes waiting at open
  std::optional<std::uint64_t> cut;        ///< the link breaks after this many bytes to the ball
  std::optional<std::uint64_t> cut_answer; ///< … or after this many bytes from the ball
  std::optional<std::uint64_t> flip_at;    ///< inverts this bit of the stream to the ball, once
  std::optional<std::uint64_t> flip_answer_at; ///< … of the stream from the ball
  std::uint64_t seed = 1;
};

/// Reads `drop=1%,flip=0.1%,dup=1%,delay=50..300ms,split,cut@1234,seed=7`; the error is a sentence
/// that names the word which is wrong and the words there are.
tl::expected<FaultPlan, std::string> parse_fault_plan(std::string_view text);

/// The plan in the words that parse_fault_plan reads; `none` for a plan that does nothing.
std::string to_string(const FaultPlan& plan);

/// Does to two streams of bytes what a plan says. It is not a link itself: whoever moves the bytes
/// pushes them in where they are sent and takes them out when they are due.
class FaultPipe {
public:
  explicit FaultPipe(const FaultPlan& plan, spec::Packets packets = spec::Packets::V1);

  /// Bytes are sent at `now`; a packet may come in any number of pushes.
  void push(Direction direction, ByteView bytes, Instant now);

  /// The next piece that has arrived by `now`; empty when there is none.
  Bytes take(Direction direction, Instant now);

  /// When take() will have more to give, `never` for not without a push.
  Instant next_due() const;

  /// Whether the plan has cut the link: nothing passes any more.
  bool cut() const { return cut_; }

  /// The link is opened again: what was under way is lost, a cut has happened and does not again.
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
    Instant held_until = never; ///< when the first part of a packet is passed on without its rest
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

/// A Transport around a Transport, with a FaultPipe between.
class FaultTransport : public Transport {
public:
  FaultTransport(std::unique_ptr<Transport> inner, const FaultPlan& plan,
                 spec::Packets packets = spec::Packets::V1);

  Instant now() const override { return inner_->now(); }
  tl::expected<void, LinkError> write(ByteView bytes) override;
  tl::expected<Bytes, LinkError> read(Instant deadline) override;

  FaultPipe& pipe() { return pipe_; }

private:
  tl::expected<void, LinkError> deliver();

  std::unique_ptr<Transport> inner_;
  FaultPipe pipe_;
};

} // namespace orb::protocol
