// Robots at the level of bytes: input and output do not depend on how time is sliced.

#include "robot/robot.h"

#include "protocol/packet.h"
#include "protocol/packet_v2.h"
#include "protocol/payload_v2.h"

#include <array>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::robot {
namespace {

using spec::ApiCommand;
using spec::V2Command;

Bytes v2(V2Command command, Bytes data = {}) {
  constexpr std::uint8_t seq = 7;
  return encode(protocol::make_request(command, std::move(data), seq));
}
Bytes v1(ApiCommand command, Bytes data = {}) {
  constexpr std::uint8_t seq = 7;
  return encode(protocol::make_command(command, std::move(data), seq));
}

/// A wall 60 cm ahead of the start.
report::Course wall_ahead() {
  report::Course course;
  course.walls.push_back({.axis = vm::Wall::Axis::Y, .at_cm = 60});
  return course;
}

/// Options with that name and place.
Options at(std::string name, double x, double y) {
  Options options;
  options.name = std::move(name);
  options.start.place = {x, y};
  return options;
}

/// Wakes a BOLT, requests collisions and samples, and drives it ahead at that speed.
void drive(Robot& bolt, std::uint8_t speed) {
  bolt.connect();
  bolt.write(v2(V2Command::Wake));
  bolt.write(v2(V2Command::CollisionDetection, {1, 20, 20, 20, 20, 50}));
  bolt.write(v2(V2Command::StreamMask, {0, 150, 0, 0x00, 0x06, 0x00, 0x00}));
  bolt.write(v2(V2Command::DriveWithHeading, {speed, 0, 0, 0}));
}

TEST(Robot, AnswersInItsOwnPackets) {
  Robot classic(spec::Robot::Sphero);
  classic.connect();
  classic.write(v1(ApiCommand::Ping));
  classic.advance(50ms);
  EXPECT_EQ(classic.read(), (Bytes{0xFF, 0xFF, 0x00, 0x07, 0x01, 0xF7}));

  Robot bolt(spec::Robot::Bolt);
  bolt.connect();
  bolt.write(v2(V2Command::Ping));
  EXPECT_FALSE(bolt.read().empty());
}

TEST(Robot, SaysTheSameHoweverTimeIsCut) {
  Robot whole(spec::Robot::Bolt, {}, wall_ahead());
  Robot pieces(spec::Robot::Bolt, {}, wall_ahead());
  drive(whole, 120);
  drive(pieces, 120);
  whole.advance(1900ms);
  for (int i = 0; i < 1900; ++i)
    pieces.advance(1ms);
  EXPECT_GE(whole.state().bumps, 1U);
  EXPECT_GE(whole.state().collisions, 1U);
  EXPECT_EQ(whole.read(), pieces.read());
  EXPECT_EQ(whole.state().pose.y_cm, pieces.state().pose.y_cm);
}

TEST(Robot, WithoutAConnectionBytesAreLost) {
  Robot bolt(spec::Robot::Bolt);
  bolt.write(v2(V2Command::Wake));
  bolt.connect();
  bolt.write(v2(V2Command::DriveWithHeading, {100, 0, 0, 0}));
  bolt.advance(1s);
  EXPECT_EQ(bolt.state().way_cm, 0);
}

TEST(Robot, ANewerOneSleepsUntilItIsWoken) {
  Robot mini(spec::Robot::Mini);
  mini.connect();
  EXPECT_TRUE(mini.state().asleep);
  mini.write(v2(V2Command::Wake));
  EXPECT_FALSE(mini.state().asleep);
  mini.write(v2(V2Command::Sleep));
  mini.advance(1s);
  EXPECT_TRUE(mini.state().asleep);
  EXPECT_TRUE(mini.connected());
}

TEST(Robot, AForkGoesItsOwnWay) {
  Robot bolt(spec::Robot::Bolt);
  drive(bolt, 80);
  bolt.advance(500ms);
  const auto fork = bolt.fork();
  bolt.advance(1s);
  const auto at = bolt.state().pose.y_cm;
  EXPECT_LT(fork->state().pose.y_cm, at);
  fork->advance(1s);
  EXPECT_EQ(fork->state().pose.y_cm, at);
  EXPECT_EQ(fork->read(), bolt.read());
  fork->write(v2(V2Command::DriveWithHeading, {80, 0, 90, 0}));
  fork->advance(1s);
  EXPECT_EQ(bolt.state().pose.y_cm, at);
  EXPECT_GT(fork->state().pose.x_cm, 10);
}

TEST(Robot, AfterAResetItIsNew) {
  for (const auto kind : {spec::Robot::Bolt, spec::Robot::SprkPlus}) {
    Robot used(kind);
    used.connect();
    used.write(v2(V2Command::Wake));
    used.write(v1(ApiCommand::Roll, {200, 0, 90, 1}));
    used.write(v2(V2Command::DriveWithHeading, {200, 0, 90, 0}));
    used.advance(3s);
    EXPECT_GT(used.state().way_cm, 50);
    used.reset();
    EXPECT_TRUE(used.connected());
    EXPECT_EQ(used.now(), Duration{});
    EXPECT_EQ(used.state().way_cm, 0);
    EXPECT_EQ(used.read(), Bytes{});
    EXPECT_EQ(used.journey().totals().distance_cm, 0);
  }
}

TEST(Robot, ShowsARobotElsewhere) {
  for (const auto kind : {spec::Robot::Bolt, spec::Robot::SprkPlus}) {
    Robot shown(kind);
    shown.connect();
    shown.write(v2(V2Command::Wake));
    vm::Sample sample;
    shown.feel(sample);
    shown.write(v1(ApiCommand::SetRgbLed, {1, 2, 3, 0}));
    shown.write(v2(V2Command::SetLedsShort, {0x3F, 1, 2, 3, 1, 2, 3}));
    shown.write(v1(ApiCommand::Roll, {200, 0, 90, 1}));
    shown.write(v2(V2Command::DriveWithHeading, {200, 0, 90, 0}));
    shown.advance(1s);
    EXPECT_EQ(shown.state().way_cm, 0) << "the other one stands";
    sample.place_cm = {30, 40};
    sample.velocity_cm_s = {0, 12, 0};
    sample.yaw_deg = 123;
    shown.feel(sample);
    shown.feel(vm::event::Collision{});
    shown.advance(1s);
    const auto state = shown.state();
    EXPECT_DOUBLE_EQ(state.pose.x_cm, 30);
    EXPECT_DOUBLE_EQ(state.pose.y_cm, 40);
    EXPECT_DOUBLE_EQ(state.pose.heading_deg, 123);
    EXPECT_DOUBLE_EQ(state.pose.speed_cm_s, 12);
    EXPECT_DOUBLE_EQ(state.way_cm, 50);
    EXPECT_EQ(state.collisions, 1);
    EXPECT_EQ(state.rgb, (vm::Color{1, 2, 3}));
    EXPECT_DOUBLE_EQ(shown.journey().totals().distance_cm, 50);
  }
}

TEST(Robot, AtRestOnlySleepIsToCome) {
  Robot mini(spec::Robot::Mini);
  mini.connect();
  mini.write(v2(V2Command::Wake));
  mini.advance(5s);
  mini.read();
  EXPECT_GT(mini.next_event(), 100s);
  mini.write(v2(V2Command::DriveWithHeading, {100, 0, 0, 0}));
  EXPECT_LT(mini.next_event(), 6s);
}

TEST(Robot, ABadLinkLosesPacketsAndEnds) {
  Options options;
  options.fault = protocol::parse_fault_plan("drop=100%").value();
  Robot deaf(spec::Robot::Bolt, options);
  deaf.connect();
  deaf.write(v2(V2Command::Ping));
  deaf.advance(1s);
  EXPECT_EQ(deaf.read(), Bytes{});

  options.fault = protocol::parse_fault_plan("cut@20").value();
  Robot cut(spec::Robot::Bolt, options);
  cut.connect();
  for (int i = 0; i < 5; ++i)
    cut.write(v2(V2Command::Ping));
  cut.advance(100ms);
  EXPECT_FALSE(cut.connected());
  cut.connect();
  EXPECT_TRUE(cut.connected());
}

TEST(Robot, LateAnswersComeWhenTheyAreDue) {
  Options options;
  options.fault = protocol::parse_fault_plan("delay=100..100ms").value();
  Robot bolt(spec::Robot::Bolt, options);
  bolt.connect();
  bolt.write(v2(V2Command::Ping));
  bolt.advance(150ms);
  EXPECT_EQ(bolt.read(), Bytes{});
  EXPECT_TRUE(bolt.next_event());
  bolt.advance(100ms);
  EXPECT_FALSE(bolt.read().empty());
}

TEST(Robot, SleepsOnBehindABadLink) {
  Options options;
  options.fault = protocol::parse_fault_plan("drop=1%").value();
  Robot classic(spec::Robot::Sphero, options);
  classic.connect();
  classic.write(v1(ApiCommand::Sleep, {0, 0, 0, 0, 0}));
  classic.advance(1s);
  classic.read();
  EXPECT_TRUE(classic.state().asleep);
  EXPECT_EQ(classic.next_event(), std::nullopt);
  classic.advance(1s);
  EXPECT_EQ(classic.now(), 2s);
}

/// Counts what it is told.
struct Witness final : vm::Observer, vm::StepObserver {
  void on_event(Instant, const vm::Event& event) override {
    bumps += std::holds_alternative<vm::event::Bump>(event) ? 1 : 0;
  }
  void on_step(Instant, const vm::Body&) override { ++steps; }
  int bumps = 0;
  int steps = 0;
};

TEST(Robot, IsWatchedWithoutItsForks) {
  Witness witness;
  Robot bolt(spec::Robot::Bolt);
  bolt.watch(&witness, &witness);
  drive(bolt, 120);
  const auto fork = bolt.fork();
  fork->schedule(std::array{vm::TimedStimulus{0s, wall_ahead().walls.front()}});
  fork->advance(3s);
  EXPECT_GT(fork->state().bumps, 0U);
  EXPECT_EQ(witness.bumps + witness.steps, 0);
  bolt.schedule(std::array{vm::TimedStimulus{0s, wall_ahead().walls.front()}});
  bolt.advance(3s);
  EXPECT_EQ(bolt.state().bumps, fork->state().bumps);
  EXPECT_EQ(witness.bumps, static_cast<int>(bolt.state().bumps));
  EXPECT_GT(witness.steps, 100);
  const auto seen = witness.steps;
  bolt.watch(nullptr, nullptr);
  drive(bolt, 120);
  bolt.advance(1s);
  EXPECT_EQ(witness.steps, seen);
}

TEST(Robot, ObeysLinesOfStimuli) {
  Robot bolt(spec::Robot::Bolt);
  EXPECT_TRUE(bolt.stimulus("at 1s push 90 200"));
  EXPECT_TRUE(bolt.stimulus("at now battery 7.1"));
  bolt.advance(100ms);
  EXPECT_NEAR(bolt.state().volts, 7.1, 0.05);
  EXPECT_EQ(bolt.state().way_cm, 0);
  bolt.advance(2s);
  EXPECT_GT(bolt.state().pose.x_cm, 5);
  EXPECT_EQ(bolt.stimulus("at 1s shake").error(),
            "it is 2.100 s already; write a later time, or leave out `at`");
  EXPECT_NE(bolt.stimulus("psuh 90 1").error().find("did you mean `push`?"), std::string::npos);
}

TEST(Robot, TakesAnyBytes) {
  rc::check("any bytes", [] {
    for (const auto kind : {spec::Robot::Sphero, spec::Robot::Bolt, spec::Robot::Rvr}) {
      Robot robot(kind);
      robot.connect();
      robot.write(v2(V2Command::Wake));
      robot.write(*rc::gen::arbitrary<Bytes>());
      robot.advance(20ms);
      robot.write(*rc::gen::arbitrary<Bytes>());
      robot.advance(2s);
      robot.read();
    }
  });
}

TEST(World, RobotsRunIntoEachOther) {
  World world;
  auto& red = **world.add(spec::Robot::Bolt, at("red", 0, 0));
  auto& blue = **world.add(spec::Robot::SprkPlus, at("blue", 0, 60));
  drive(red, 120);
  world.advance(1500ms);
  EXPECT_GE(red.state().bumps, 1U);
  EXPECT_GE(blue.state().bumps, 1U);
  EXPECT_GT(blue.state().pose.y_cm, 60);
  EXPECT_EQ(red.fork(), nullptr);

  const auto fork = world.fork();
  fork->advance(1s);
  world.advance(1s);
  EXPECT_EQ(fork->robots()[1]->state().pose.y_cm, blue.state().pose.y_cm);
  EXPECT_EQ(fork->robots()[0]->read(), red.read());

  world.reset();
  EXPECT_EQ(world.now(), Duration{});
  EXPECT_EQ(blue.state().pose.y_cm, 60);
  world.advance(1s);
  EXPECT_EQ(blue.state().bumps, 0U);
}

TEST(World, SaysWhereARobotCannotStand) {
  World world;
  ASSERT_TRUE(world.add(spec::Robot::Bolt, at("red", 0, 0)));
  EXPECT_EQ(world.add(spec::Robot::Bolt, at("red", 50, 0)).error(),
            "there is a robot `red` already; give each its own name");
  const auto inside = world.add(spec::Robot::Bolt, at("blue", 1, 0));
  EXPECT_EQ(inside.error(), "`blue` would stand in `red`: their middles are 1.0 cm apart, and 7.3 "
                            "is the least");
}

TEST(World, ARobotMayComeLater) {
  World world;
  world.advance(1234567us);
  auto& late = **world.add(spec::Robot::Mini);
  EXPECT_EQ(late.now(), world.now());
  drive(late, 100);
  world.advance(1s);
  EXPECT_GT(late.state().pose.y_cm, 10);
  EXPECT_EQ(late.now(), world.now());
}

} // namespace
} // namespace orb::robot
