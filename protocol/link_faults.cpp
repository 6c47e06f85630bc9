#include "protocol/link_faults.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "protocol/plan_words.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace orb::protocol {
namespace {

/// How long the first part of a packet waits for its rest before it is passed on alone.
constexpr Duration hold_time = 100ms;
/// Time between the pieces of a split packet.
constexpr Duration split_gap = 1ms;
/// Interval at which merged bytes arrive; about the polling interval of a radio link.
constexpr Duration merge_raster = 20ms;
/// The message used for bursts.
constexpr auto storm_message = static_cast<std::uint8_t>(spec::AsyncId::SensorData);
constexpr std::uint64_t storm_most_messages = 8;
constexpr std::uint64_t storm_most_payload = 80; // bytes; a full sensor frame has up to 64
constexpr double percents = 100;                 // in a whole
constexpr std::uint64_t stray_most_bytes = 3;    // real balls have been seen to send one or two

constexpr std::array<std::string_view, 14> words = {
    "drop=", "flip=",  "dup=", "dup-request=", "storm=", "delay=",       "split",
    "merge", "stale=", "cut@", "cut-answer@",  "flip@",  "flip-answer@", "seed="};

bool read_delay_range(std::string_view text, FaultPlan& plan) {
  const auto [first, last] = split_range(text);
  const auto least = read_delay(first);
  const auto most = read_delay(last);
  if (!least || !most || *most < *least)
    return false;
  plan.delay_least = *least;
  plan.delay_most = *most;
  return true;
}

/// Returns the value set by an item, if it is of that type; otherwise null.
double* rate_of(FaultPlan& plan, std::string_view name) {
  return name == "drop="          ? &plan.drop
         : name == "flip="        ? &plan.flip
         : name == "dup="         ? &plan.dup
         : name == "dup-request=" ? &plan.dup_request
         : name == "storm="       ? &plan.storm
                                  : nullptr;
}

std::optional<std::uint64_t>* place_of(FaultPlan& plan, std::string_view name) {
  return name == "cut@"           ? &plan.cut
         : name == "cut-answer@"  ? &plan.cut_answer
         : name == "flip@"        ? &plan.flip_at
         : name == "flip-answer@" ? &plan.flip_answer_at
                                  : nullptr;
}

tl::expected<void, std::string> read_item(std::string_view item, FaultPlan& plan) {
  const auto [name, value] = split_item(item);
  if (auto* rate = rate_of(plan, name)) {
    const auto read = read_rate(value);
    if (!read)
      return wrong_word(item, "a rate is written in percent, such as `1%` or `0.1%`");
    *rate = *read;
    return {};
  }
  if (auto* place = place_of(plan, name)) {
    *place = parse_number<std::uint64_t>(value);
    if (!*place)
      return wrong_word(item, "a place is a whole number, such as `cut@1234`");
    return {};
  }
  if (name == "delay=") {
    if (!read_delay_range(value, plan))
      return wrong_word(item, "a delay is written `50..300ms` or `200ms`, at most one hour");
    return {};
  }
  if (name == "seed=" || name == "stale=") {
    constexpr std::uint64_t most_stale = 1000; // more than any known link buffers
    const auto count = parse_number<std::uint64_t>(value);
    if (!count || (name == "stale=" && *count > most_stale))
      return wrong_word(item, name == "seed=" ? "a seed is a whole number"
                                              : "it takes a number from 0 to 1000");
    if (name == "seed=")
      plan.seed = *count;
    else
      plan.stale = static_cast<std::uint32_t>(*count);
    return {};
  }
  if (item == "split" || item == "merge") {
    (item == "split" ? plan.split : plan.merge) = true;
    return {};
  }
  return wrong_word(
      item,
      fmt::format("unknown; {}",
                  did_you_mean(name, words, fmt::format("use one of {}", fmt::join(words, " ")))));
}

void add_rate(std::string& out, std::string_view name, double rate) {
  if (rate > 0)
    out += fmt::format("{}{:g}%,", name, rate * percents);
}

} // namespace

tl::expected<FaultPlan, std::string> parse_fault_plan(std::string_view text) {
  FaultPlan plan;
  if (text == "none")
    return plan;
  const auto read = read_words(text, [&](std::string_view item) { return read_item(item, plan); });
  if (!read)
    return tl::unexpected(read.error());
  return plan;
}

std::string to_string(const FaultPlan& plan) {
  std::string out;
  add_rate(out, "drop=", plan.drop);
  add_rate(out, "flip=", plan.flip);
  add_rate(out, "dup=", plan.dup);
  add_rate(out, "dup-request=", plan.dup_request);
  add_rate(out, "storm=", plan.storm);
  if (plan.delay_most > Duration{})
    out += fmt::format("delay={:g}..{:g}ms,", static_cast<double>(plan.delay_least.count()) / 1e6,
                       static_cast<double>(plan.delay_most.count()) / 1e6);
  if (plan.split)
    out += "split,";
  if (plan.merge)
    out += "merge,";
  if (plan.stale > 0)
    out += fmt::format("stale={},", plan.stale);
  for (const auto& [name, place] :
       {std::pair{"cut@", plan.cut}, std::pair{"cut-answer@", plan.cut_answer},
        std::pair{"flip@", plan.flip_at}, std::pair{"flip-answer@", plan.flip_answer_at}})
    if (place)
      out += fmt::format("{}{},", name, *place);
  if (out.empty())
    return "none";
  return out + fmt::format("seed={}", plan.seed);
}

FaultPipe::Side::Side(Direction which, spec::Packets packets)
    : direction(which), decoder(Decoder(which)) {
  if (packets == spec::Packets::V2)
    decoder.emplace<DecoderV2>();
}

FaultPipe::FaultPipe(const FaultPlan& plan, spec::Packets packets)
    : plan_(plan), packets_(packets), random_{plan.seed} {
  queue_stale(Instant{});
}

FaultPipe::Side& FaultPipe::side(Direction direction) {
  return direction == Direction::ToBall ? to_ball_ : from_ball_;
}

void FaultPipe::push(Direction direction, ByteView bytes, Instant now) {
  if (cut_ || bytes.empty())
    return;
  auto& way = side(direction);
  auto& flip = direction == Direction::ToBall ? plan_.flip_at : plan_.flip_answer_at;
  const auto bits = static_cast<std::uint64_t>(bytes.size()) * 8;
  if (flip && *flip >= way.bits_in && *flip < way.bits_in + bits) {
    // Find packets in the bytes sent; damage only what arrives.
    Bytes damaged(bytes.begin(), bytes.end());
    const auto bit = *flip - way.bits_in;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ 1U << bit % 8);
    way.bits_in += bits;
    flip.reset();
    queue(way, damaged, now);
    return;
  }
  way.bits_in += bits;
  std::visit([&](auto& decoder) { decoder.feed(bytes); }, way.decoder);
  find_packets(way, now);
  const bool pending =
      std::visit([](const auto& decoder) -> bool { return decoder.pending(); }, way.decoder);
  way.held_until = pending ? now + hold_time : never;
}

void FaultPipe::find_packets(Side& way, Instant now) {
  std::visit(
      [&](auto& decoder) {
        while (const auto item = decoder.next())
          pass_item(way, *item, now);
      },
      way.decoder);
}

void FaultPipe::pass_item(Side& way, const Item& item, Instant now) {
  switch (item.kind) {
  case Item::Kind::Command: pass_packet(way, item.raw, What::Request, now); break;
  case Item::Kind::Response: pass_packet(way, item.raw, What::Answer, now); break;
  case Item::Kind::Async: pass_packet(way, item.raw, What::Message, now); break;
  case Item::Kind::Noise: queue(way, item.raw, now); break;
  case Item::Kind::BadChecksum:
  case Item::Kind::Fragment:
    queue(way, item.raw.first(1), now); // the decoder reports the rest again
    break;
  }
}

void FaultPipe::pass_item(Side& way, const ItemV2& item, Instant now) {
  if (item.kind != ItemV2::Kind::Packet)
    return queue(way, item.raw, now);
  const bool is_answer = spec::has(item.packet.flags, spec::V2Flag::Response);
  pass_packet(way, item.raw,
              is_answer                            ? What::Answer
              : way.direction == Direction::ToBall ? What::Request
                                                   : What::Message,
              now);
}

void FaultPipe::pass_packet(Side& way, ByteView bytes, What what, Instant now) {
  const Bytes packet(bytes.begin(), bytes.end()); // the view is invalid after the next item
  if (what == What::Answer && random_.chance(plan_.storm))
    queue_storm(way, now);
  const auto rate = what == What::Answer    ? plan_.dup
                    : what == What::Request ? plan_.dup_request
                                            : 0;
  damage_and_queue(way, packet, now);
  if (random_.chance(rate))
    damage_and_queue(way, packet, now);
}

void FaultPipe::damage_and_queue(Side& way, Bytes packet, Instant now) {
  if (random_.chance(plan_.drop))
    return;
  if (random_.chance(plan_.flip)) {
    const auto bit = random_.below(packet.size() * 8);
    packet[bit / 8] = static_cast<std::uint8_t>(packet[bit / 8] ^ 1U << bit % 8);
  }
  queue(way, packet, now);
}

void FaultPipe::queue(Side& way, ByteView bytes, Instant now) {
  auto due = now;
  if (plan_.delay_most > Duration{})
    due += plan_.delay_least +
           Duration(static_cast<Duration::rep>(random_.below(
               static_cast<std::uint64_t>((plan_.delay_most - plan_.delay_least).count()) + 1)));
  if (plan_.merge)
    due += merge_raster - due.time_since_epoch() % merge_raster;
  due = std::max(due, way.last_due);
  while (!bytes.empty()) {
    const auto size = plan_.split ? 1 + random_.below(bytes.size()) : bytes.size();
    const auto piece = bytes.first(size);
    way.pieces.push_back({due, {piece.begin(), piece.end()}});
    bytes = bytes.subspan(size);
    if (!bytes.empty())
      due += split_gap;
  }
  way.last_due = due;
}

/// Makes an unsolicited message from the ball.
Bytes FaultPipe::message() {
  Bytes data(1 + random_.below(storm_most_payload));
  for (auto& byte : data)
    byte = static_cast<std::uint8_t>(random_.next());
  if (packets_ == spec::Packets::V1)
    return encode(Async{storm_message, std::move(data)});
  PacketV2 packet;
  packet.did = static_cast<int>(spec::V2Message::Sample) >> 8;
  packet.cid = static_cast<std::uint8_t>(spec::V2Message::Sample);
  packet.seq = spec::v2_message_seq;
  packet.data = std::move(data);
  return encode(packet);
}

/// Makes the answer to a request of an earlier client.
Bytes FaultPipe::old_answer() {
  const auto seq = static_cast<std::uint8_t>(random_.next());
  if (packets_ == spec::Packets::V1)
    return encode(Response{static_cast<std::uint8_t>(spec::ResponseCode::Ok), seq, {}});
  PacketV2 packet;
  packet.flags = static_cast<std::uint8_t>(spec::V2Flag::Response);
  packet.seq = seq;
  return encode(packet);
}

void FaultPipe::queue_storm(Side& way, Instant now) {
  for (auto left = 1 + random_.below(storm_most_messages); left > 0; --left)
    queue(way, message(), now);
}

void FaultPipe::queue_stale(Instant now) {
  for (std::uint32_t i = 0; i < plan_.stale; ++i) {
    Bytes stray(random_.below(stray_most_bytes + 1));
    for (auto& byte : stray)
      byte = static_cast<std::uint8_t>(random_.next());
    queue(from_ball_, stray, now);
    queue(from_ball_, old_answer(), now);
  }
}

Bytes FaultPipe::take(Direction direction, Instant now) {
  auto& way = side(direction);
  if (now >= way.held_until) {
    std::visit([](auto& decoder) { decoder.expire(); }, way.decoder);
    find_packets(way, now);
    way.held_until = never;
  }
  if (cut_ || way.pieces.empty() || way.pieces.front().due > now)
    return {};
  Bytes piece = std::move(way.pieces.front().bytes);
  way.pieces.pop_front();
  while (plan_.merge && !way.pieces.empty() && way.pieces.front().due <= now) {
    piece.insert(piece.end(), way.pieces.front().bytes.begin(), way.pieces.front().bytes.end());
    way.pieces.pop_front();
  }
  const auto limit = direction == Direction::ToBall ? plan_.cut : plan_.cut_answer;
  if (limit && way.bytes_out + piece.size() >= *limit) {
    piece.resize(*limit - way.bytes_out);
    cut_ = true;
  }
  way.bytes_out += piece.size();
  return piece;
}

Instant FaultPipe::next_due() const {
  auto due = never;
  for (const auto* way : {&to_ball_, &from_ball_}) {
    due = std::min(due, way->held_until);
    if (!way->pieces.empty())
      due = std::min(due, way->pieces.front().due);
  }
  return due;
}

void FaultPipe::reconnect(Instant now) {
  to_ball_ = Side(Direction::ToBall, packets_);
  from_ball_ = Side(Direction::FromBall, packets_);
  if (cut_) {
    plan_.cut.reset();
    plan_.cut_answer.reset();
  }
  cut_ = false;
  queue_stale(now);
}

FaultTransport::FaultTransport(std::unique_ptr<Transport> inner, const FaultPlan& plan,
                               spec::Packets packets)
    : inner_(std::move(inner)), pipe_(plan, packets) {}

namespace {

tl::unexpected<LinkError> cut_error() {
  return tl::unexpected(LinkError{LinkError::Kind::Closed, "the link was cut by the fault plan"});
}

} // namespace

tl::expected<void, LinkError> FaultTransport::deliver() {
  for (auto piece = pipe_.take(Direction::ToBall, now()); !piece.empty();
       piece = pipe_.take(Direction::ToBall, now()))
    if (auto written = inner_->write(piece); !written)
      return written;
  if (pipe_.cut())
    return cut_error();
  return {};
}

tl::expected<void, LinkError> FaultTransport::write(ByteView bytes) {
  if (pipe_.cut())
    return cut_error();
  pipe_.push(Direction::ToBall, bytes, now());
  return deliver();
}

tl::expected<Bytes, LinkError> FaultTransport::read(Instant deadline) {
  while (true) {
    if (auto delivered = deliver(); !delivered)
      return tl::unexpected(delivered.error());
    if (auto piece = pipe_.take(Direction::FromBall, now()); !piece.empty())
      return piece;
    if (pipe_.cut())
      return cut_error();
    const auto until = std::min(deadline, pipe_.next_due());
    auto read = inner_->read(until);
    if (!read)
      return read;
    pipe_.push(Direction::FromBall, *read, now());
    if (read->empty() && now() >= deadline && pipe_.next_due() > now())
      return Bytes{};
  }
}

} // namespace orb::protocol
