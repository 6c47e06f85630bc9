// Drives virtual robots with packets, as the test of a client library would.
#include <orb/protocol/packet.h>
#include <orb/protocol/payload_v2.h>
#include <orb/robot/robot.h>

#include <gtest/gtest.h>

using namespace std::chrono_literals;
using orb::robot::Robot;

namespace {

TEST(Robot, AClassicOneKeepsItsColour) {
  Robot ball(orb::spec::Robot::Sphero);
  ball.connect();
  const orb::Bytes red{255, 0, 0, 1}; // 1: for good
  ball.write(encode(orb::protocol::make_command(orb::spec::ApiCommand::SetRgbLed, red, 7)));
  ball.advance(100ms);
  EXPECT_EQ(ball.read(), (orb::Bytes{0xFF, 0xFF, 0x00, 0x07, 0x01, 0xF7})); // 0: done
  EXPECT_EQ(ball.state().rgb.red, 255);
}

TEST(Robot, ABoltDrivesUntilItIsStopped) {
  Robot bolt(orb::spec::Robot::Bolt);
  bolt.connect();
  const auto send = [&](orb::spec::V2Command command, orb::Bytes data) {
    bolt.write(encode(orb::protocol::make_request(command, std::move(data), 7)));
  };
  send(orb::spec::V2Command::Wake, {});
  send(orb::spec::V2Command::DriveWithHeading, {80, 0, 90, 0}); // speed, heading 0090, flags
  bolt.advance(1s);
  EXPECT_TRUE(bolt.state().drives);
  const auto half_way = bolt.fork(); // it goes its own way from here

  send(orb::spec::V2Command::DriveWithHeading, {0, 0, 90, 0});
  bolt.advance(2s);
  EXPECT_FALSE(bolt.state().drives);
  EXPECT_GT(bolt.state().pose.x_cm, 30);

  half_way->advance(1s);
  EXPECT_GT(half_way->state().pose.x_cm, bolt.state().pose.x_cm);
}

} // namespace
