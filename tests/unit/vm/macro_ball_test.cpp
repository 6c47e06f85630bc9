// Macros on a whole ball: flags against clients and programs, and effects on body and lamps.

#include "vm/ball.h"

#include "protocol/decoder.h"

#include <gtest/gtest.h>

namespace orb::vm {
namespace {

using spec::ApiCommand;

class Seen : public Observer {
public:
  std::vector<Color> colors;
  std::vector<event::Drive> drives;
  std::vector<event::Marker> markers;
  std::vector<event::Macro> commands;
  std::vector<event::MacroEnd> ends;
  std::vector<event::Sleep> sleeps;
  bool idle_at_sleep = false;
  const Ball* ball = nullptr;

  void on_event(Instant, const Event& event) override {
    if (const auto* led = std::get_if<event::Led>(&event))
      colors.push_back(led->color);
    if (const auto* drive = std::get_if<event::Drive>(&event))
      drives.push_back(*drive);
    if (const auto* marker = std::get_if<event::Marker>(&event))
      markers.push_back(*marker);
    if (const auto* command = std::get_if<event::Macro>(&event))
      commands.push_back(*command);
    if (const auto* end = std::get_if<event::MacroEnd>(&event))
      ends.push_back(*end);
    if (const auto* sleep = std::get_if<event::Sleep>(&event)) {
      sleeps.push_back(*sleep);
      idle_at_sleep = ball->idle();
    }
  }
};

class MacroOnBall : public ::testing::Test {
protected:
  Seen seen;
  std::unique_ptr<Ball> ball;

  void SetUp() override {
    BallOptions options;
    options.observer = &seen;
    ball = std::make_unique<Ball>(options);
    seen.ball = ball.get();
    ball->connect();
  }

  void tell(ApiCommand command, Bytes data = {}) {
    ball->receive(protocol::encode(protocol::make_command(command, std::move(data))));
    advance(0ms);
  }
  void advance(Duration time) { ball->advance_to(ball->now() + time); }
  void run(std::string_view hex) {
    tell(ApiCommand::SaveTemporaryMacro, *from_hex(hex));
    tell(ApiCommand::RunMacro, {0xFF});
  }
};

TEST_F(MacroOnBall, DrivesTheBodyAndStopsItAtTheEnd) {
  run("FF 01 1D FF 00 00 07 D0 00"); // full speed for 2 s, motor_control
  advance(1900ms);
  EXPECT_GT(ball->body().pose().y_cm, 100);
  advance(5s);
  EXPECT_TRUE(ball->body().stopped());
}

TEST_F(MacroOnBall, ExclusiveDriveKeepsTheClientOutUntilItEnds) {
  run("FF 02 0B 03 E8 00");
  seen.drives.clear();
  tell(ApiCommand::Roll, {100, 0, 0, 1});
  EXPECT_TRUE(seen.drives.empty());
  advance(1s);
  tell(ApiCommand::Roll, {100, 0, 0, 1});
  EXPECT_EQ(seen.drives.size(), 1U);
}

TEST_F(MacroOnBall, ItsColourComesBeforeTheApplicationsAndGoesWithIt) {
  tell(ApiCommand::SetRgbLed, {0, 0, 9, 0});
  run("FF 00 07 09 00 00 0A 00");
  EXPECT_EQ(ball->led(), (Color{9, 0, 0}));
  tell(ApiCommand::SetRgbLed, {0, 9, 0, 0});
  EXPECT_EQ(ball->led(), (Color{9, 0, 0}));
  advance(20ms);
  EXPECT_EQ(ball->led(), (Color{0, 9, 0}));
}

TEST_F(MacroOnBall, AFadeShowsItsColoursOnTheWay) {
  seen.colors.clear();
  run("FF 00 07 00 00 00 00 14 14 00 00 00 64 0B 00 64 0B 00 01 00");
  advance(1s);
  std::size_t reds = 0;
  for (const auto& color : seen.colors)
    reds += color.red > 0 && color.green == 0 && color.blue == 0 ? 1 : 0;
  EXPECT_GE(reds, 20U);
}

TEST_F(MacroOnBall, TheClientChangesASystemDelayWhileItRuns) {
  run("FF 00 01 03 E8 1E 02 06 00 00 00 1F 15 AA 00");
  advance(500ms);
  tell(ApiCommand::SetMacroParameter, {0, 0, 10});
  advance(505ms);
  EXPECT_TRUE(seen.markers.empty());
  advance(6ms);
  EXPECT_EQ(seen.markers.size(), 1U);
}

TEST_F(MacroOnBall, TellsHowAMacroEnded) {
  using Reason = event::MacroEnd::Reason;
  struct Case {
    const char* hex;
    int command;
    Reason reason;
  };
  tell(ApiCommand::SaveMacro, *from_hex("41 08 00")); // inhibited while connected
  for (const auto& [hex, command, reason] :
       {Case{"FF 00 15 01 00", 2, Reason::Ended}, Case{"FF 00 0C 63", 1, Reason::NoSuchMacro},
        Case{"FF 00 15 01 0D 63 00", 2, Reason::NoSuchMacro},
        Case{"FF 00 1B", 1, Reason::StreamEnd}, Case{"FF 00 20 00 09 61 00", 0, Reason::BadCommand},
        Case{"FF 00 0C 41", 1, Reason::Inhibited}, Case{"FF 00 0E 00 00 00", 1, Reason::Slept}}) {
    seen.ends.clear();
    run(hex);
    ASSERT_EQ(seen.ends.size(), 1U) << hex;
    EXPECT_EQ(seen.ends[0].macro, 255) << hex;
    EXPECT_EQ(seen.ends[0].command, command) << hex;
    EXPECT_EQ(seen.ends[0].reason, reason) << hex;
  }
  EXPECT_EQ(seen.sleeps.size(), 1U);
  EXPECT_FALSE(seen.idle_at_sleep) << "a run is not over before the ball sleeps";
}

TEST_F(MacroOnBall, TellsWhyAMacroDoesNotRun) {
  EXPECT_EQ(ball->run_macro(0), MacroOutcome::BadParameter);
  EXPECT_EQ(ball->run_macro(64), MacroOutcome::NoSuchMacro);
  tell(ApiCommand::SaveMacro, *from_hex("41 08 00"));
  EXPECT_EQ(ball->run_macro(65), MacroOutcome::Inhibited);
  ball->disconnect();
  EXPECT_EQ(ball->run_macro(65), MacroOutcome::Done);
  EXPECT_EQ(ball->run_macro(65), MacroOutcome::Busy);
}

TEST_F(MacroOnBall, ANewSpeedLetsARotationGoOn) {
  run("FF 00 1A 00 5A 03 E8 0B 00 FA 25 00 00 0B 03 E8 00"); // rotate 90 in 1 s; set_speed 0 at 250
                                                             // ms
  advance(260ms);
  EXPECT_NEAR(ball->body().yaw_deg(), 23, 1);
  advance(300ms);
  EXPECT_NEAR(ball->body().yaw_deg(), 50, 1);
  advance(500ms);
  EXPECT_DOUBLE_EQ(ball->body().yaw_deg(), 90);
}

TEST_F(MacroOnBall, ANewSpeedKeepsTheHeadingAndARollDuringARotationIsIgnored) {
  run("FF 00 05 64 00 00 64 1A 00 5A 03 E8 05 64 00 B4 64 25 C8 00 0B 07 D0 00");
  // Roll along 0, turn by 90 within a second, roll along 180 without effect, then faster.
  advance(1200ms);
  EXPECT_DOUBLE_EQ(ball->body().heading_setpoint_deg(), 90);
  EXPECT_EQ(ball->body().speed_setpoint(), 200);
}

TEST_F(MacroOnBall, WhatTheBodyIgnoresIsNoDrive) {
  tell(ApiCommand::SetStabilization, {0});
  tell(ApiCommand::Roll, {100, 0, 0, 1});
  run("FF 00 05 64 00 00 64 25 C8 00 00");
  advance(1s);
  EXPECT_TRUE(seen.drives.empty());
  tell(ApiCommand::SetStabilization, {1});
  tell(ApiCommand::Roll, {100, 0, 0, 1});
  EXPECT_EQ(seen.drives.size(), 1U);
}

TEST_F(MacroOnBall, TheEndOfAStealthyMacroIsNoActivity) {
  tell(ApiCommand::SetInactivityTimeout, {0, 60});
  run("FF 20 0B C3 50 00"); // 50 s
  advance(61s);
  EXPECT_TRUE(ball->asleep());
}

TEST_F(MacroOnBall, StealthDoesNotKeepTheBallAwake) {
  tell(ApiCommand::SetInactivityTimeout, {0, 60});
  run("FF 00 0B FF FF 0C FF"); // forever
  advance(200s);
  EXPECT_FALSE(ball->asleep());
  tell(ApiCommand::AbortMacro);
  run("FF 20 0B FF FF 0C FF");
  advance(200s);
  EXPECT_TRUE(ball->asleep());
}

TEST_F(MacroOnBall, ASleepCommandWakesItAfterMilliseconds) {
  run("FF 00 0E 05 DC 00"); // 1500 ms
  advance(1ms);
  EXPECT_TRUE(ball->asleep());
  advance(1400ms);
  EXPECT_TRUE(ball->asleep());
  advance(200ms);
  EXPECT_FALSE(ball->asleep());
}

TEST_F(MacroOnBall, StopOnDisconnectSparesAMacroThatDoesNotAllowIt) {
  for (const bool allowed : {false, true}) {
    SetUp();
    tell(ApiCommand::SetTemporaryOptionFlags, {0, 0, 0, 1});
    run(allowed ? "FF 04 1D FF 00 00 FF FF 00" : "FF 00 1D FF 00 00 FF FF 00");
    advance(2s);
    ball->disconnect();
    advance(4s);
    EXPECT_EQ(ball->body().stopped(), allowed);
  }
}

TEST_F(MacroOnBall, AWallSendsItToAnotherMacro) {
  tell(ApiCommand::SaveMacro, *from_hex("40 01 25 00 00 15 EE 00"));
  ball->apply(Wall{Wall::Axis::Y, 50});
  run("FF 00 27 01 14 00 14 00 0A 23 40 1D FF 00 00 FF FF 00");
  advance(5s);
  ASSERT_EQ(seen.markers.size(), 1U);
  EXPECT_EQ(seen.markers[0].marker, 0xEE);
  EXPECT_EQ(seen.markers[0].macro, 0x40);
}

TEST_F(MacroOnBall, WaitUntilStoppedWaitsForTheBody) {
  run("FF 00 1D FF 00 00 03 E8 25 00 00 19 27 10 15 AA 00");
  advance(1s);
  EXPECT_TRUE(seen.markers.empty());
  advance(100ms);
  EXPECT_TRUE(seen.markers.empty()) << "it still rolls";
  advance(5s);
  EXPECT_EQ(seen.markers.size(), 1U);
}

} // namespace
} // namespace orb::vm
