#include "run/tether/pilot.h"

#include "protocol/packet_v2.h"
#include "tests/fakes/far_robot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace orb::run {
namespace {

/// Records what is sent to the robot.
class Overheard final : public protocol::Transport {
public:
  explicit Overheard(protocol::Transport& link) : link_(link) {}
  Instant now() const override { return link_.now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    decoder_.feed(bytes);
    while (const auto item = decoder_.next())
      if (item->kind == protocol::ItemV2::Kind::Packet)
        packets.push_back(item->packet);
    return link_.write(bytes);
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    return link_.read(deadline);
  }

  /// Returns the data of the matrix commands in the order sent.
  std::string on_matrix() const {
    std::string text;
    for (const auto& packet : packets)
      for (const auto command : {spec::V2Command::MatrixPixel, spec::V2Command::MatrixColor,
                                 spec::V2Command::MatrixText})
        if (packet.did == spec::info(command).did() && packet.cid == spec::info(command).cid())
          text += fmt::format("{}: {}\n", spec::info(command).name, to_hex(packet.data));
    return text;
  }
  std::vector<protocol::PacketV2> packets;

private:
  protocol::Transport& link_;
  protocol::DecoderV2 decoder_;
};

struct Scene {
  explicit Scene(spec::Robot which)
      : far(which, *protocol::parse_fault_plan("seed=1"), 10ms), link(*far.link),
        tether(link, which, TetherBudgets{}), pilot(tether, which, *tether.begin(Aim::Zero)) {
    link.packets.clear();
  }
  void live(Duration time) {
    for (const auto end = link.now() + time; link.now() < end;) {
      pilot.watch();
      ASSERT_TRUE(tether.pump(end, [&](const RobotMessage& said) { pilot.hear(said); }));
    }
  }

  test::FarRobot far;
  Overheard link;
  Tether tether;
  Pilot pilot;
};

TEST(Pilot, EveryLampThatIsPaintedArrives) {
  Scene scene(spec::Robot::Bolt);
  EXPECT_TRUE(scene.pilot.has_matrix());
  scene.pilot.paint(0, 7, {255, 0, 0});
  scene.pilot.paint(1, 7, {255, 0, 0});
  scene.pilot.paint(8, 0, {255, 0, 0});
  scene.pilot.paint(0, -1, {255, 0, 0});
  scene.pilot.paint(0, 7, {0, 0, 1});
  EXPECT_EQ(scene.pilot.picture()[7 * 8], (vm::Color{0, 0, 1}));
  // As fast as the robot can take them: one every 75 ms, the first after setup.
  scene.live(75ms * 3 + 10ms);
  EXPECT_EQ(scene.link.on_matrix(), "set-matrix-pixel: 00 07 FF 00 00\n"
                                    "set-matrix-pixel: 01 07 FF 00 00\n"
                                    "set-matrix-pixel: 00 07 00 00 01\n");
}

TEST(Pilot, AColorPaintsOverWhatHasNotLeft) {
  Scene scene(spec::Robot::Bolt);
  for (int x = 0; x < vm::Matrix::side; ++x)
    scene.pilot.paint(x, 0, {255, 0, 0});
  scene.pilot.show({0, 255, 0});
  scene.pilot.paint(3, 3, {0, 0, 255});
  scene.live(3s);
  EXPECT_EQ(scene.link.on_matrix(), "set-matrix-color: 00 FF 00\n"
                                    "set-matrix-pixel: 03 03 00 00 FF\n");
  EXPECT_EQ(scene.pilot.picture()[0], (vm::Color{0, 255, 0}));
}

TEST(Pilot, PaintingDoesNotKeepTheRobotFromDriving) {
  Scene scene(spec::Robot::Bolt);
  scene.pilot.steer(0, 60, 10s);
  for (int i = 0; i < 80; ++i)
    scene.pilot.paint(i % 8, i / 8 % 8, {255, 0, 0});
  scene.live(4s); // longer than one command lasts
  EXPECT_TRUE(scene.far.drives());
  scene.pilot.stop();
  scene.live(500ms);
  EXPECT_FALSE(scene.far.drives());
}

TEST(Pilot, SaysAText) {
  Scene scene(spec::Robot::Bolt);
  scene.pilot.say("A\n0123456789012345678901234567890", {1, 2, 3});
  EXPECT_NE(scene.pilot.picture(), vm::filled({}));
  scene.live(500ms);
  EXPECT_EQ(scene.link.on_matrix(),
            "scroll-matrix-text: 01 02 03 0A 00 41 3F 30 31 32 33 34 35 36 37 38 39 30 31 32 33 34 "
            "35 36 37 38 39 30 31 32 00\n");
  scene.live(30s);
  EXPECT_EQ(scene.pilot.picture(), vm::filled({})); // the text has scrolled out
  scene.pilot.paint(1, 1, {9, 9, 9});
  scene.pilot.clear_matrix();
  EXPECT_EQ(scene.pilot.picture(), vm::filled({}));
  scene.live(500ms);
  EXPECT_TRUE(scene.link.on_matrix().ends_with("set-matrix-color: 00 00 00\n"));
}

TEST(Pilot, ARobotWithoutAMatrixIsToldNothing) {
  Scene scene(spec::Robot::Mini);
  EXPECT_FALSE(scene.pilot.has_matrix());
  scene.pilot.paint(1, 1, {255, 0, 0});
  scene.pilot.say("hello", {255, 0, 0});
  scene.pilot.clear_matrix();
  scene.live(1s);
  EXPECT_EQ(scene.link.on_matrix(), "");
}

/// Starts driving and does not stop.
tl::expected<void, Failure> set_off(Tether& robot) {
  robot.obey(vm::Roll{0, 80, vm::Go::Drive});
  for (const auto end = robot.now() + 1s; robot.now() < end;)
    if (auto pumped = robot.pump(end, [](const RobotMessage&) {}); !pumped)
      return pumped;
  return {};
}

TEST(Attended, StopsTheRobotWhateverHappens) {
  for (const auto& row : spec::robots)
    for (const bool breaks : {false, true}) {
      test::FarRobot far(row.robot, *protocol::parse_fault_plan("seed=1"), 10ms);
      Tether robot(*far.link, row.robot, TetherBudgets{});
      ASSERT_TRUE(robot.begin(Aim::Zero)) << row.name;
      const auto end = drive_attended(robot, [&]() -> tl::expected<void, Failure> {
        auto driven = set_off(robot);
        EXPECT_TRUE(far.drives()) << row.name;
        if (breaks)
          throw std::runtime_error("a vase fell");
        return driven;
      });
      EXPECT_TRUE(end.stopped) << row.name;
      EXPECT_FALSE(far.drives()) << row.name << " is left driving";
      EXPECT_EQ(end.driven.has_value(), !breaks) << row.name;
      if (breaks) {
        EXPECT_EQ(end.driven.error().code, ExitCode::Bug) << row.name;
        EXPECT_NE(end.driven.error().message.find("a vase fell"), std::string::npos);
      }
    }
}

/// A link that is lost at the first use.
class LostLink final : public protocol::Transport {
public:
  explicit LostLink(const protocol::Transport& clock) : clock_(clock) {}
  Instant now() const override { return clock_.now(); }
  tl::expected<void, protocol::LinkError> write(ByteView /*bytes*/) override { return lost(); }
  tl::expected<Bytes, protocol::LinkError> read(Instant /*deadline*/) override { return lost(); }

private:
  static tl::unexpected<protocol::LinkError> lost() {
    return tl::unexpected(
        protocol::LinkError{protocol::LinkError::Kind::Closed, "the other end closed it"});
  }
  const protocol::Transport& clock_;
};

/// Opens links that are lost at once, then the robot's.
Reopen works_after(int lost, test::FarRobot& far) {
  return [lost, &far]() mutable -> std::unique_ptr<protocol::Transport> {
    if (lost-- > 0)
      return std::make_unique<LostLink>(*far.link);
    return std::move(far.link);
  };
}

TEST(Attended, StopsOverTheFirstLinkThatWorksAgain) {
  test::FarRobot far(spec::Robot::Mini, *protocol::parse_fault_plan("seed=1"), 10ms);
  LostLink lost(*far.link);
  Tether robot(*far.link, spec::Robot::Mini, TetherBudgets{}, {}, works_after(2, far));
  ASSERT_TRUE(robot.begin(Aim::Zero));
  const auto end = drive_attended(robot, [&]() -> tl::expected<void, Failure> {
    auto driven = set_off(robot);
    EXPECT_TRUE(driven && far.drives());
    robot.relink(lost);
    return robot.pump(robot.now() + 1s, [](const RobotMessage&) {});
  });
  EXPECT_EQ(end.driven.error().code, ExitCode::LinkLost);
  EXPECT_EQ(far.link, nullptr); // it was opened
  EXPECT_TRUE(robot.is_reopened());
  EXPECT_TRUE(end.stopped);
  EXPECT_FALSE(far.drives());
}

TEST(Attended, StopsOverANewLinkIfTheOldOneIsLostAtTheStop) {
  test::FarRobot far(spec::Robot::Mini, *protocol::parse_fault_plan("seed=1"), 10ms);
  LostLink lost(*far.link);
  Tether robot(*far.link, spec::Robot::Mini, TetherBudgets{}, {}, works_after(0, far));
  ASSERT_TRUE(robot.begin(Aim::Zero));
  const auto end = drive_attended(robot, [&]() -> tl::expected<void, Failure> {
    auto driven = set_off(robot);
    robot.relink(lost);
    return driven;
  });
  EXPECT_TRUE(end.driven);
  EXPECT_TRUE(end.stopped);
  EXPECT_FALSE(far.drives());
}

TEST(Attended, StopsOverANewLinkIfNobodyIsThereToFinish) {
  test::FarRobot far(spec::Robot::Mini, *protocol::parse_fault_plan("seed=1"), 10ms);
  LostLink lost(*far.link);
  {
    Tether robot(*far.link, spec::Robot::Mini, TetherBudgets{}, {}, works_after(0, far));
    ASSERT_TRUE(robot.begin(Aim::Zero));
    ASSERT_TRUE(set_off(robot));
    robot.relink(lost);
  }
  EXPECT_FALSE(far.drives());
}

TEST(Attended, GivesUpWhenNoLinkWorks) {
  test::FarRobot far(spec::Robot::Mini, *protocol::parse_fault_plan("seed=1"), 10ms);
  LostLink lost(*far.link);
  int left = 2;
  Tether robot(*far.link, spec::Robot::Mini, TetherBudgets{}, {},
               [&]() -> std::unique_ptr<protocol::Transport> {
                 return left-- > 0 ? std::make_unique<LostLink>(*far.link) : nullptr;
               });
  ASSERT_TRUE(robot.begin(Aim::Zero));
  const auto end = drive_attended(robot, [&]() -> tl::expected<void, Failure> {
    robot.relink(lost);
    return robot.pump(robot.now() + 1s, [](const RobotMessage&) {});
  });
  EXPECT_FALSE(end.stopped);
  EXPECT_EQ(end.driven.error().code, ExitCode::LinkLost);
}

} // namespace
} // namespace orb::run
