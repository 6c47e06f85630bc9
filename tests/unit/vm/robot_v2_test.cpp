// Virtual robots with packets v2, tested with requests of third-party clients.

#include "vm/robot_v2.h"

#include "base/text/text.h"
#include "protocol/describe_v2.h"
#include "protocol/payload_v2.h"
#include "vm/common/bluetooth.h"

#include <bit>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>

namespace orb::vm {
namespace {

using protocol::PacketV2;
using spec::Robot;
using spec::V2Command;
using spec::V2Error;
using spec::V2Message;

/// A client that sends packets and records answers.
class PacketClient {
public:
  explicit PacketClient(Robot which, Observer* observer = nullptr) : robot(spec::info(which)) {
    BallOptions options;
    options.observer = observer;
    options.robot = which;
    options.driving = spec::driving(which);
    ball = std::make_unique<Ball>(options);
    v2 = std::make_unique<RobotV2>(*ball, which, bluetooth_address(1));
    ball->connect();
    v2->connect();
  }

  /// Returns the error of the answer; its data is in `answer`.
  V2Error ask(V2Command command, Bytes data = {}) {
    return ask(address(protocol::make_request(command, std::move(data), seq), robot));
  }
  V2Error ask(const PacketV2& request) {
    answer.reset();
    v2->receive(encode(request));
    live(1ms);
    EXPECT_TRUE(answer) << spec::info(static_cast<V2Command>(request.did << 8 | request.cid)).name;
    seq = static_cast<std::uint8_t>((seq + 1) % 255);
    return answer ? static_cast<V2Error>(answer->error) : V2Error::Failed;
  }
  void live(Duration time) {
    for (const auto end = ball->now() + time; ball->now() < end;) {
      ball->advance_to(std::min(end, ball->now() + 1ms));
      v2->run();
      while (const auto packet = v2->take_packet()) {
        decoder.feed(*packet);
        while (const auto item = decoder.next())
          take(item->packet);
      }
    }
  }
  int count(V2Message message) const {
    return static_cast<int>(std::count_if(said.begin(), said.end(), [&](const PacketV2& one) {
      return (one.did << 8 | one.cid) == static_cast<int>(message);
    }));
  }

  const spec::RobotInfo& robot;
  std::unique_ptr<Ball> ball;
  std::unique_ptr<RobotV2> v2;
  protocol::DecoderV2 decoder;
  std::optional<PacketV2> answer;
  std::vector<PacketV2> said;
  std::uint8_t seq = 0;

private:
  void take(const PacketV2& packet) {
    if (spec::has(packet.flags, spec::V2Flag::Response))
      answer = packet;
    else
      said.push_back(packet);
  }
};

std::vector<Robot> newer_robots() {
  std::vector<Robot> all;
  for (const auto& row : spec::robots)
    if (row.packets == spec::Packets::V2)
      all.push_back(row.robot);
  return all;
}

Bytes example_of(const spec::V2CommandInfo& row) {
  std::vector<std::string> words;
  std::istringstream text{std::string(row.example)};
  for (std::string word; text >> word;)
    words.push_back(word);
  const auto data = protocol::encode_operands(row.command, words);
  EXPECT_TRUE(data) << row.name << ": " << (data ? "" : data.error());
  return data.value_or(Bytes{});
}

TEST(RobotV2, AnswersTheExampleOfEachCommandThatItKnowsAndRefusesTheOthers) {
  for (const auto which : newer_robots()) {
    for (const auto& row : spec::v2_commands) {
      PacketClient client(which);
      client.ask(V2Command::Wake);
      client.live(3s);
      if (row.command == V2Command::StreamStart && spec::knows(client.robot, row))
        client.ask(V2Command::StreamConfigure, {1, 0, 10, 2});
      const bool shell = row.command == V2Command::Shell;
      // Nothing has been stored that could be shown.
      const bool shows = row.command == V2Command::MatrixPlay ||
                         row.command == V2Command::MatrixPlayLoop ||
                         row.command == V2Command::MatrixShowFrame;
      const auto name = fmt::format("{}: {}", client.robot.name, row.name);
      auto request =
          address(protocol::make_request(row.command, example_of(row), client.seq), client.robot);
      if (row.command == V2Command::StreamConfigure) // its example is for the second processor
        request.target = spec::v2_target(spec::V2Processor::Secondary);
      const auto error = client.ask(request);
      if (!spec::knows(client.robot, row)) {
        EXPECT_TRUE(error == V2Error::BadCommand || error == V2Error::BadDevice) << name;
        continue;
      }
      EXPECT_EQ(error, shell   ? V2Error::NotImplemented
                       : shows ? V2Error::Failed
                               : V2Error::Success)
          << name;
      if (shell || shows)
        continue;
      EXPECT_EQ(client.answer->data.empty(),
                protocol::DescriberV2{}.fields_of(*client.answer).empty())
          << name << " answers what no row names";
    }
  }
}

/// The requests of a well-known client before a program, with streams every 150 ms.
TEST(RobotV2, GivesAnEducationalClientWhatItAsksFor) {
  struct Stream {
    Robot robot;
    std::uint32_t mask;
    std::uint32_t extended;
  };
  for (const auto& [which, mask, extended] :
       {Stream{Robot::Bolt, 0x03C7E27A, 0x03840000},
        Stream{Robot::BoltPlus, 0x03C7E27A, 0x03840000},
        Stream{Robot::Mini, 0x0007E27A, 0x03800000}, Stream{Robot::Bb9e, 0x0007E27A, 0x03800000},
        Stream{Robot::R2d2, 0x0007E278, 0x07800000}}) {
    const auto values = static_cast<std::size_t>(std::popcount(mask) + std::popcount(extended));
    PacketClient client(which);
    const auto& name = client.robot.name;
    ASSERT_EQ(client.ask(V2Command::Wake), V2Error::Success);
    client.live(2100ms);
    EXPECT_EQ(client.ask(V2Command::LocatorFlags, {0}), V2Error::Success) << name;
    EXPECT_EQ(client.ask(V2Command::ResetLocator), V2Error::Success) << name;
    EXPECT_EQ(client.ask(V2Command::GyroMaxNotify, {1}), V2Error::Success) << name;
    EXPECT_EQ(client.ask(V2Command::CollisionDetection, {1, 90, 90, 130, 130, 1}), V2Error::Success)
        << name;
    Bytes request{0, 150, 0};
    append_u32(request, mask);
    Bytes more;
    append_u32(more, extended);
    EXPECT_EQ(client.ask(V2Command::StreamMask, request), V2Error::Success) << name;
    EXPECT_EQ(client.ask(V2Command::StreamExtended, more), V2Error::Success) << name;
    client.ball->apply(Wall{.axis = Wall::Axis::Y, .at_cm = 60});
    EXPECT_EQ(client.ask(V2Command::DriveWithHeading, {255, 0, 0, 0}), V2Error::Success) << name;
    client.live(1500ms);
    EXPECT_GE(client.count(V2Message::Sample), 9) << name;
    EXPECT_EQ(client.count(V2Message::Collision), 1) << name;
    for (const auto& one : client.said) {
      const bool sample = one.did == 0x18 && one.cid == 0x02;
      const bool collision = one.did == 0x18 && one.cid == 0x12;
      EXPECT_TRUE(!sample || one.data.size() == values * sizeof(float)) << name;
      EXPECT_TRUE(!collision || one.data.size() == 16) << name;
    }
  }
}

/// Clients ask for the extended sensors right after the others, and then expect a value.
TEST(RobotV2, ExtendedSensorsDoNotDelayAStream) {
  PacketClient client(Robot::Mini);
  ASSERT_EQ(client.ask(V2Command::Wake), V2Error::Success);
  EXPECT_EQ(client.ask(V2Command::StreamMask, {0, 37, 0, 0, 1, 0, 0}), V2Error::Success);
  client.live(30ms);
  EXPECT_EQ(client.ask(V2Command::StreamExtended, {0, 0, 0, 0}), V2Error::Success);
  client.live(6ms);
  EXPECT_EQ(client.count(V2Message::Sample), 1);
  EXPECT_EQ(client.ask(V2Command::StreamMask, {0, 37, 0, 0, 0, 0, 0}), V2Error::Success);
  EXPECT_EQ(client.ask(V2Command::StreamExtended, {0x03, 0x80, 0, 0}), V2Error::Success);
  client.live(38ms);
  EXPECT_EQ(client.count(V2Message::Sample), 2);
  EXPECT_EQ(client.ask(V2Command::StreamExtended, {0, 0, 0, 0}), V2Error::Success);
  client.live(100ms);
  EXPECT_EQ(client.count(V2Message::Sample), 2);
}

/// Three tokens on two processors, each in a separate packet.
TEST(RobotV2, StreamsEachTokenOfAnRvr) {
  PacketClient client(Robot::Rvr);
  ASSERT_EQ(client.ask(V2Command::Wake), V2Error::Success);
  const auto ask = [&](V2Command command, spec::V2Processor processor, Bytes data) {
    auto request =
        address(protocol::make_request(command, std::move(data), client.seq), client.robot);
    request.target = spec::v2_target(processor);
    return client.ask(request);
  };
  using enum spec::V2Processor;
  EXPECT_EQ(ask(V2Command::StreamConfigure, Secondary, {1, 0, 1, 2, 0, 2, 2}), V2Error::Success);
  EXPECT_EQ(ask(V2Command::StreamConfigure, Secondary, {2, 0, 6, 2, 0, 9, 2, 0, 11, 2}),
            V2Error::Success);
  EXPECT_EQ(ask(V2Command::StreamConfigure, Primary, {1, 0, 3, 0, 0, 9, 2}), V2Error::Success);
  EXPECT_EQ(ask(V2Command::StreamStart, Secondary, {0, 150}), V2Error::Success);
  EXPECT_EQ(ask(V2Command::StreamStart, Primary, {0, 150}), V2Error::Success);
  client.live(1s);
  std::map<std::pair<int, int>, std::size_t> sizes;
  for (const auto& one : client.said)
    if (one.cid == 0x3D)
      sizes[{one.source, one.data[0]}] = one.data.size();
  const std::map<std::pair<int, int>, std::size_t> expected{
      {{0x12, 1}, 1 + 24}, {{0x12, 2}, 1 + 24}, {{0x11, 1}, 1 + 13}};
  EXPECT_EQ(sizes, expected);
}

TEST(RobotV2, DrawsOnTheMatrixOfABoltAndSaysWhenItHasPlayed) {
  struct Pictures final : Observer {
    void on_event(Instant, const Event& event) override {
      if (const auto* matrix = std::get_if<event::Matrix>(&event))
        all.push_back(matrix->pixels);
    }
    std::vector<Matrix::Pixels> all;
  } pictures;
  PacketClient client(Robot::Bolt, &pictures);
  client.ask(V2Command::Wake);
  EXPECT_EQ(client.ask(V2Command::MatrixPixel, {2, 3, 255, 0, 0}), V2Error::Success);
  ASSERT_EQ(pictures.all.size(), 1U);
  EXPECT_EQ(pictures.all.back()[3 * 8 + 2], (Color{255, 0, 0}));
  EXPECT_EQ(client.ask(V2Command::MatrixText, {0, 0, 255, 30, 0, 'h', 'i', 0}), V2Error::Success);
  client.live(2s);
  EXPECT_GT(pictures.all.size(), 10U);
  EXPECT_EQ(client.count(V2Message::TextOver), 1);
  Bytes frame(34, 0xFF);
  frame[0] = frame[1] = 0;
  EXPECT_EQ(client.ask(V2Command::MatrixSaveFrame, frame), V2Error::Success);
  EXPECT_EQ(client.ask(V2Command::MatrixFrames), V2Error::Success);
  EXPECT_EQ(client.answer->data, (Bytes{0, 0}));
  EXPECT_EQ(client.ask(V2Command::MatrixSaveAnimation, {7, 10, 0, 1, 1, 2, 3, 0, 2, 0, 0, 0, 0}),
            V2Error::Success);
  EXPECT_EQ(client.ask(V2Command::MatrixPlay, {7}), V2Error::Success);
  client.live(1s);
  EXPECT_EQ(client.count(V2Message::MatrixAnimationOver), 1);
  EXPECT_EQ(client.ask(V2Command::MatrixPlay, {8}), V2Error::Failed);
}

TEST(RobotV2, ADroidThatWasJustWokenDropsWhatMovesIt) {
  PacketClient client(Robot::R2d2);
  client.ask(V2Command::Sleep);
  client.ask(V2Command::Wake);
  EXPECT_EQ(client.ask(V2Command::DriveWithHeading, {60, 0, 0, 0}), V2Error::Success);
  EXPECT_FALSE(client.ball->body().is_driven());
  client.live(2s);
  EXPECT_EQ(client.ask(V2Command::DriveWithHeading, {60, 0, 0, 0}), V2Error::Success);
  EXPECT_TRUE(client.ball->body().is_driven());
}

TEST(RobotV2, BackwardItFacesWhereItIsToldAndRollsTheOtherWay) {
  PacketClient client(Robot::Bolt);
  client.ask(V2Command::Wake);
  client.ask(V2Command::DriveWithHeading, {80, 0, 0, 1});
  client.live(1500ms);
  const auto back = client.ball->body().world_pose();
  EXPECT_LT(back.y_cm, -20);
  EXPECT_NEAR(back.heading_deg, 0, 1);
  client.ask(V2Command::DriveWithHeading, {0, 0, 0, 0});
  client.live(1s);
  EXPECT_EQ(client.ball->body().world_pose().speed_cm_s, 0);
  client.ask(V2Command::ResetYaw);
  client.ask(V2Command::DriveWithHeading, {80, 0, 90, 1});
  client.live(1500ms);
  EXPECT_LT(client.ball->body().world_pose().x_cm, -20);
  EXPECT_NEAR(client.ball->body().world_pose().heading_deg, 90, 1);
}

TEST(RobotV2, ADroidTellsWhereItsThirdLegIs) {
  PacketClient client(Robot::R2q5);
  client.ask(V2Command::Wake);
  const auto leg = [&] {
    EXPECT_EQ(client.ask(V2Command::GetLegPosition), V2Error::Success);
    return protocol::read_f32(client.answer->data, 0);
  };
  EXPECT_EQ(leg(), 0);
  client.ask(V2Command::LegAction, {1});
  EXPECT_EQ(leg(), 1);
  client.ask(V2Command::SetLegPosition, {0x3F, 0, 0, 0});
  EXPECT_EQ(leg(), 0.5);
}

TEST(RobotV2, PutToSleepItEndsItsLinkHalfAMinuteLater) {
  PacketClient client(Robot::Mini);
  client.ask(V2Command::Wake);
  client.ask(V2Command::Sleep);
  client.live(20s);
  client.ask(V2Command::Wake);
  client.live(20s);
  EXPECT_TRUE(client.ball->connected());
  client.ask(V2Command::Sleep);
  client.live(29s);
  EXPECT_TRUE(client.ball->connected());
  client.live(2s);
  EXPECT_FALSE(client.ball->connected());
}

TEST(RobotV2, AnRvrSaysThatItWillSleepAndStaysAwakeIfItIsPinged) {
  PacketClient client(Robot::Rvr);
  client.ask(V2Command::Wake);
  client.live(295s);
  EXPECT_EQ(client.count(V2Message::WillSleep), 1);
  EXPECT_EQ(client.ask(V2Command::Ping), V2Error::Success);
  client.live(200s);
  EXPECT_EQ(client.count(V2Message::DidSleep), 0);
  client.live(101s);
  EXPECT_EQ(client.count(V2Message::DidSleep), 1);
}

TEST(RobotV2, ABoltPlusHasOneProcessor) {
  PacketClient client(Robot::BoltPlus);
  auto request = protocol::make_request(V2Command::Ping, {}, 0);
  request.flags |= static_cast<std::uint8_t>(spec::V2Flag::HasTarget);
  request.target = spec::v2_target(spec::V2Processor::Secondary);
  EXPECT_EQ(client.ask(request), V2Error::BadTarget);
}

TEST(RobotV2, ReportsItsBatteryAsItsOwn) {
  PacketClient client(Robot::Mini);
  EXPECT_EQ(client.ask(V2Command::GetVoltage), V2Error::Success);
  EXPECT_NEAR(read_u16(client.answer->data, 0), 390, 5);
  EXPECT_EQ(client.ask(V2Command::GetVoltageState), V2Error::Success);
  EXPECT_EQ(client.answer->data[0], 1);
  EXPECT_EQ(client.ask(V2Command::VoltageNotify, {1}), V2Error::Success);
  client.ball->apply(stimulus::Battery{3.4});
  client.live(10ms);
  ASSERT_EQ(client.count(V2Message::VoltageState), 1);
  EXPECT_EQ(client.said.back().data[0], 2);
}

} // namespace
} // namespace orb::vm
