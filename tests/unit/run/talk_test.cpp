#include "protocol/payload_v2.h"
#include "run/tether/find_robot.h"
#include "run/tether/hail.h"
#include "run/tether/talk_v2.h"

#include <gtest/gtest.h>

namespace orb::run {
namespace {

using protocol::PacketV2;

/// Sends one answer and is then silent.
class Once final : public protocol::Transport {
public:
  explicit Once(Bytes said) : said_(std::move(said)) {}
  Instant now() const override { return now_; }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    written.insert(written.end(), bytes.begin(), bytes.end());
    return {};
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    if (!said_.empty())
      return std::exchange(said_, {});
    now_ = std::max(now_, deadline);
    return Bytes{};
  }

  Bytes written;

private:
  Bytes said_;
  Instant now_{};
};

Bytes message(spec::V2Message which) {
  PacketV2 packet;
  packet.did = static_cast<std::uint8_t>(static_cast<int>(which) >> 8);
  packet.cid = static_cast<std::uint8_t>(which);
  packet.seq = spec::v2_message_seq;
  return encode(packet);
}

std::string why_silent(const Bytes& said) {
  Once link(said);
  TalkV2 talk(link, spec::info(spec::Robot::Mini));
  return talk.request(spec::V2Command::GetMac).error().message;
}

TEST(Talk, ARobotThatSaysThatItSleepsIsNotTooFarAway) {
  EXPECT_NE(why_silent(message(spec::V2Message::DidSleep)).find("gone to sleep"),
            std::string::npos);
  EXPECT_NE(why_silent({}).find("closer"), std::string::npos);
  EXPECT_NE(why_silent(message(spec::V2Message::WillSleep)).find("closer"), std::string::npos);
}

TEST(Hail, AClassicBallHearsNothingOfPacketsV2) {
  Once link(encode(protocol::Response{0, 7, {}}));
  Hail hail(link);
  const Bytes ping{0xFF, 0xFF, 0x00, 0x01, 0x07, 0x01, 0xF6};
  ASSERT_TRUE(hail.write(ping).has_value());
  ASSERT_TRUE(hail.read(link.now() + 2s).has_value());
  EXPECT_EQ(hail.answered(), spec::Packets::V1);
  ASSERT_TRUE(hail.read(link.now() + 2s).has_value());
  EXPECT_EQ(link.written, ping);
}

TEST(Hail, ANewerRobotShowsByItsAnswerToAPingOfItsOwn) {
  PacketV2 answer;
  answer.flags = static_cast<std::uint8_t>(spec::V2Flag::Response);
  answer.did = 0x10;
  Once link(encode(answer));
  Hail hail(link);
  ASSERT_TRUE(hail.write(Bytes{0xFF}).has_value());
  const auto heard = hail.read(link.now() + 2s);
  ASSERT_FALSE(heard.has_value());
  EXPECT_EQ(heard.error().kind, protocol::LinkError::Kind::Unfit);
  EXPECT_EQ(hail.answered(), spec::Packets::V2);
}

TEST(Hail, WhatComesBackAsItWasSentIsAnEcho) {
  Once link(encode(protocol::make_request(spec::V2Command::Ping, {}, 0)));
  Hail hail(link);
  ASSERT_TRUE(hail.read(link.now() + 2s).has_value());
  EXPECT_TRUE(hail.echoes());
  EXPECT_FALSE(hail.answered());
}

} // namespace
} // namespace orb::run
