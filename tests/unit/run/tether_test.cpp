#include "run/tether/find_robot.h"
#include "run/tether/run_tethered.h"

#include "tests/fakes/far_robot.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>

namespace orb::run {
namespace {

constexpr std::string_view square = "10 for I = 0 to 3\n20 RGB 255,0,0\n30 goroll I * 90,60,1\n"
                                    "40 delay 1000\n50 goroll I * 90,0,0\n60 delay 1500\n"
                                    "70 print xpos, ypos\n80 next I\n";

/// What the robot was told.
struct Told : vm::Observer {
  void on_event(Instant, const vm::Event& event) override {
    if (const auto* led = std::get_if<vm::event::Led>(&event))
      colors.push_back(led->color);
  }
  std::vector<vm::Color> colors;
};

struct Robot : Told, test::FarRobot {
  explicit Robot(spec::Robot which, std::string_view plan = "seed=1")
      : FarRobot(which, *protocol::parse_fault_plan(plan), 10ms, this) {}
};

struct Heard final : Listener {
  void on_event(Duration, const vm::Event& event) override {
    if (const auto* print = std::get_if<vm::event::Print>(&event))
      prints += print->text;
    if (const auto* drive = std::get_if<vm::event::Drive>(&event))
      rolls.push_back(drive->roll);
  }
  void on_fault(Duration, const ProgramError&) override { ++faults; }
  std::string prints;
  std::vector<vm::Roll> rolls;
  int faults = 0;
};

tl::expected<TetheredEnding, Failure> run_on(Robot& robot, spec::Robot which,
                                             std::string_view program, Heard& heard) {
  const auto inputs = test::program_of(program);
  TetherOptions options;
  options.robot = which;
  return run_tethered(inputs, {}, heard, nullptr, *robot.link, options);
}

TEST(Tether, DrivesEachRobotAsTheVirtualBallDrives) {
  for (const auto& row : spec::robots) {
    const auto inputs = test::program_of(square);
    Heard here;
    Options options;
    options.model = row.robot;
    const auto alone = run(inputs, options, here, nullptr);
    ASSERT_TRUE(alone.has_value());

    Robot robot(row.robot);
    Heard there;
    const auto driven = run_on(robot, row.robot, square, there);
    ASSERT_TRUE(driven.has_value()) << row.name << ": " << driven.error().message;
    EXPECT_FALSE(driven->failure) << row.name << ": " << driven->failure->message;
    EXPECT_TRUE(driven->ending.robot_stopped.value_or(false)) << row.name;
    EXPECT_EQ(there.faults, 0) << row.name;
    const auto& a = alone->sight.pose;
    const auto& b = driven->ending.sight.pose;
    constexpr double near_cm = 5;
    EXPECT_LT(std::hypot(a.x_cm - b.x_cm, a.y_cm - b.y_cm), near_cm)
        << row.name << ": " << a.x_cm << "," << a.y_cm << " and " << b.x_cm << "," << b.y_cm;
    EXPECT_EQ(here.rolls, there.rolls) << row.name;
    EXPECT_EQ(robot.ball->body().speed_setpoint(), 0) << row.name;
    EXPECT_EQ(robot.colors.front().red, 255) << row.name;
    EXPECT_EQ(robot.ball->led(), vm::Color{}) << row.name << " is left shining";
  }
}

TEST(Tether, LeavesNoRobotDrivingWhateverTheLinkDoes) {
  constexpr std::string_view plans[] = {"drop=10%",      "dup=10%",       "flip=5%",
                                        "split,drop=2%", "merge,stale=8", "delay=50..300ms",
                                        "storm=30%"};
  for (const auto which : {spec::Robot::Sphero, spec::Robot::Mini, spec::Robot::Rvr})
    for (const auto plan : plans)
      for (int seed = 1; seed <= 3; ++seed) {
        const auto words = fmt::format("{},seed={}", plan, seed);
        Robot robot(which, words);
        Heard heard;
        const auto driven = run_on(robot, which, square, heard);
        if (driven && driven->ending.robot_stopped.value_or(false)) {
          EXPECT_EQ(robot.ball->body().speed_setpoint(), 0) << words << " is left driving";
          continue;
        }
        robot.live_on(2100ms); // it stops by itself within two seconds of the last command
        EXPECT_EQ(robot.ball->body().speed_setpoint(), 0) << words << " is left driving";
      }
}

TEST(Tether, WithoutSamplesTheRobotIsStoppedAndTheRunEnds) {
  for (const auto which : {spec::Robot::Sphero, spec::Robot::Bolt}) {
    Robot robot(which, "cut-answer@4000,seed=1");
    Heard heard;
    const auto driven = run_on(robot, which, square, heard);
    ASSERT_TRUE(driven.has_value());
    ASSERT_TRUE(driven->failure.has_value());
    EXPECT_EQ(driven->failure->code, ExitCode::LinkLost);
  }
}

TEST(Tether, ANamelessRobotIsFound) {
  for (const auto which :
       {spec::Robot::Sphero, spec::Robot::Mini, spec::Robot::Bolt, spec::Robot::Rvr}) {
    Robot robot(which);
    const auto found = find_robot(*robot.link, 3s);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    EXPECT_EQ(*found, which);
  }
  Robot droid(spec::Robot::R2d2);
  const auto found = find_robot(*droid.link, 3s);
  ASSERT_FALSE(found.has_value());
  EXPECT_NE(found.error().message.find("--robot r2d2"), std::string::npos);
}

} // namespace
} // namespace orb::run
