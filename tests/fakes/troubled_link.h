#pragma once

#include "protocol/decoder.h"
#include "protocol/packet.h"
#include "protocol/packet_v2.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"
#include "protocol/transport.h"
#include "spec/robots.h"

#include <optional>
#include <vector>

// Links to a robot with one fault each: silence, sleep, busy answers, interruption.

namespace orb::test {

/// A packet v1 or v2 that drives, or that carries a sample.
struct Seen {
  bool is_roll = false;
  bool is_raw = false;
  bool switches_off = false; ///< the stabilization
  bool is_sample = false;
  int speed = 0; ///< of a roll
  int heading_deg = 0;
  Bytes raw;
  std::uint8_t seq = 0;
  std::optional<protocol::PacketV2> v2;
};

/// Decodes the packets of one direction.
class Watcher {
public:
  explicit Watcher(protocol::Direction direction) : v1_(direction) {}

  std::vector<Seen> see(ByteView bytes) {
    std::vector<Seen> all;
    v1_.feed(bytes);
    while (const auto item = v1_.next())
      if (item->kind != protocol::Item::Kind::Noise)
        all.push_back(seen(*item));
    if (!all.empty())
      return all;
    v2_.feed(bytes);
    while (const auto item = v2_.next())
      if (item->kind == protocol::ItemV2::Kind::Packet)
        all.push_back(seen(*item));
    return all;
  }

private:
  static Seen seen(const protocol::Item& item) {
    Seen one;
    one.raw.assign(item.raw.begin(), item.raw.end());
    one.seq = item.seq;
    one.is_sample = item.kind == protocol::Item::Kind::Async &&
                    item.code == static_cast<std::uint8_t>(spec::AsyncId::SensorData);
    if (item.kind != protocol::Item::Kind::Command)
      return one;
    const auto is = [&](spec::ApiCommand command) {
      return item.did == spec::did(command) && item.cid == spec::cid(command);
    };
    one.is_raw = is(spec::ApiCommand::SetRawMotorValues);
    one.switches_off = is(spec::ApiCommand::SetStabilization) && item.data[0] == 0;
    one.is_roll = is(spec::ApiCommand::Roll);
    if (one.is_roll) {
      one.speed = item.data[0];
      one.heading_deg = static_cast<int>(read_u16(item.data, 1));
    }
    return one;
  }
  static Seen seen(const protocol::ItemV2& item) {
    const auto& packet = item.packet;
    Seen one;
    one.raw = item.raw;
    one.seq = packet.seq;
    one.v2 = packet;
    if (packet.seq == spec::v2_message_seq) {
      const auto* row = spec::find_v2_message(packet.did, packet.cid);
      one.is_sample = row != nullptr && (row->message == spec::V2Message::Sample ||
                                         row->message == spec::V2Message::ServiceSample);
      return one;
    }
    if (spec::has(packet.flags, spec::V2Flag::Response))
      return one;
    const auto* row = spec::find_v2_command(packet.did, packet.cid);
    one.is_raw = row != nullptr && row->command == spec::V2Command::RawMotors;
    one.switches_off =
        row != nullptr && row->command == spec::V2Command::SetStabilization && packet.data[0] == 0;
    one.is_roll = row != nullptr && row->command == spec::V2Command::DriveWithHeading;
    if (one.is_roll) {
      one.speed = packet.data[0];
      one.heading_deg = static_cast<int>(read_u16(packet.data, 1));
    }
    return one;
  }

  protocol::Decoder v1_;
  protocol::DecoderV2 v2_;
};

/// Passes everything on.
class PassingLink : public protocol::Transport {
public:
  explicit PassingLink(protocol::Transport& inner) : inner_(inner) {}
  Instant now() const override { return inner_.now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    return inner_.write(bytes);
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    return inner_.read(deadline);
  }

protected:
  protocol::Transport& inner_;
};

/// Loses the first command that switches stabilization off.
class LosingLink final : public PassingLink {
public:
  using PassingLink::PassingLink;
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    for (const auto& one : told_.see(bytes))
      if (one.switches_off && !lost)
        return lost = true, tl::expected<void, protocol::LinkError>{};
    return inner_.write(bytes);
  }
  bool lost = false;

private:
  Watcher told_{protocol::Direction::ToBall};
};

/// Interrupts at an instant, as Ctrl-C does.
class InterruptedLink final : public PassingLink {
public:
  InterruptedLink(protocol::Transport& inner, Instant at) : PassingLink(inner), at_(at) {}
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    if (now() < at_)
      return inner_.read(deadline);
    at_ = never;
    return tl::unexpected(
        protocol::LinkError{protocol::LinkError::Kind::Interrupted, "interrupted"});
  }

private:
  Instant at_;
};

/// Drops all samples from an instant on, and nothing else.
class MuteLink final : public PassingLink {
public:
  MuteLink(protocol::Transport& inner, Instant at) : PassingLink(inner), at_(at) {}
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    for (const auto& one : told_.see(bytes))
      if (now() > at_ && one.is_roll && one.speed == 0 && !stopped)
        stopped = now();
    return inner_.write(bytes);
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    auto bytes = inner_.read(deadline);
    if (!bytes)
      return bytes;
    Bytes left;
    for (const auto& one : said_.see(*bytes)) {
      if (one.is_sample && now() > at_)
        continue;
      if (one.is_sample)
        last_sample = now();
      left.insert(left.end(), one.raw.begin(), one.raw.end());
    }
    return left;
  }
  std::optional<Instant> last_sample;
  std::optional<Instant> stopped; ///< when a roll with speed 0 was sent after the last sample

private:
  Instant at_;
  Watcher told_{protocol::Direction::ToBall};
  Watcher said_{protocol::Direction::FromBall};
};

/// Simulates a sleeping computer: nothing is read for a while, then everything arrives at once.
class SleepingLink final : public PassingLink {
public:
  SleepingLink(protocol::Transport& inner, Instant at, Duration length)
      : PassingLink(inner), at_(at), length_(length) {}
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    for (const auto& one : told_.see(bytes))
      if (one.is_roll && (rolls.empty() || rolls.back() != std::pair{one.heading_deg, one.speed}))
        rolls.emplace_back(one.heading_deg, one.speed);
    return inner_.write(bytes);
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    if (now() < at_)
      return inner_.read(deadline);
    const auto until = now() + length_;
    at_ = never;
    Bytes all;
    while (now() < until) {
      const auto bytes = inner_.read(until);
      if (!bytes)
        return bytes;
      all.insert(all.end(), bytes->begin(), bytes->end());
    }
    return all;
  }
  std::vector<std::pair<int, int>> rolls; ///< heading and speed, each once

private:
  Instant at_;
  Duration length_;
  Watcher told_{protocol::Direction::ToBall};
};

/// Answers `busy` to raw motors and to rolls of at least that speed; the robot does not get them.
class BusyLink final : public PassingLink {
public:
  BusyLink(protocol::Transport& inner, int least_speed)
      : PassingLink(inner), least_speed_(least_speed) {}
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    for (const auto& one : told_.see(bytes))
      if (one.is_raw || (one.is_roll && one.speed >= least_speed_)) {
        const auto answer = busy(one);
        answers_.insert(answers_.end(), answer.begin(), answer.end());
        return {};
      }
    return inner_.write(bytes);
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    auto bytes = inner_.read(answers_.empty() ? deadline : std::min(deadline, now() + 20ms));
    if (bytes)
      bytes->insert(bytes->end(), answers_.begin(), answers_.end());
    answers_.clear();
    return bytes;
  }

private:
  static Bytes busy(const Seen& one) {
    if (!one.v2)
      return encode(protocol::Response{
          static_cast<std::uint8_t>(spec::ResponseCode::MemoryBusy), one.seq, {}});
    auto answer = *one.v2;
    answer.flags = static_cast<std::uint8_t>(spec::V2Flag::Response);
    answer.error = static_cast<std::uint8_t>(spec::V2Error::Busy);
    answer.data.clear();
    return encode(answer);
  }

  int least_speed_;
  Watcher told_{protocol::Direction::ToBall};
  Bytes answers_;
};

/// Inserts nonsense in valid packets: samples too short or too long, meaningless values, answers to
/// no request, unknown error codes.
class BabblingLink final : public PassingLink {
public:
  BabblingLink(protocol::Transport& inner, std::uint64_t seed, const spec::RobotInfo& robot)
      : PassingLink(inner), state_(seed), robot_(robot) {}
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    auto bytes = inner_.read(deadline);
    if (bytes && draw(3) == 0) {
      const auto more = babble();
      bytes->insert(bytes->end(), more.begin(), more.end());
    }
    return bytes;
  }

private:
  std::uint32_t draw(std::uint32_t below) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint32_t>(state_ >> 33U) % below;
  }
  Bytes babble() {
    Bytes data(draw(70));
    for (auto& byte : data)
      byte = static_cast<std::uint8_t>(draw(256));
    if (robot_.packets == spec::Packets::V1) {
      // A frame of the right length is a sample, whatever its content.
      data.resize(data.size() | 1U);
      return encode(protocol::Async{static_cast<std::uint8_t>(draw(12)), data});
    }
    protocol::PacketV2 packet;
    const auto& row = spec::v2_messages[draw(static_cast<std::uint32_t>(spec::v2_messages.size()))];
    packet.did = static_cast<std::uint8_t>(static_cast<int>(row.message) >> 8);
    packet.cid = static_cast<std::uint8_t>(row.message);
    packet.seq = spec::v2_message_seq;
    if (row.message == spec::V2Message::ServiceSample)
      data.resize(data.size() % 4 == 1 ? data.size() + 1 : data.size()); // otherwise it is a sample
    else if (row.message == spec::V2Message::Sample && data.size() % 4 == 0)
      data.assign(data.size(), 0xFF); // not numbers
    if (draw(4) == 0) {
      packet.flags = static_cast<std::uint8_t>(spec::V2Flag::Response);
      packet.seq = static_cast<std::uint8_t>(200 + draw(50));
      packet.error = static_cast<std::uint8_t>(draw(256));
    }
    packet.data = std::move(data);
    return encode(packet);
  }

  std::uint64_t state_;
  const spec::RobotInfo& robot_;
};

} // namespace orb::test
