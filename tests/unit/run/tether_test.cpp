#include "run/tether/find_robot.h"
#include "run/tether/hold_robot.h"
#include "run/tether/run_tethered.h"

#include "tests/fakes/far_robot.h"
#include "tests/fakes/troubled_link.h"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>

namespace orb::run {
namespace {

constexpr std::string_view square = "10 for I = 0 to 3\n20 RGB 255,0,0\n30 goroll I * 90,60,1\n"
                                    "40 delay 1000\n50 goroll I * 90,0,0\n60 delay 1500\n"
                                    "70 print xpos, ypos\n80 next I\n";

/// Raw motors: a ball without stabilization ignores a roll of speed 0.
constexpr std::string_view raw = "10 raw 1,120,1,120\n20 delay 1000\n30 raw 0,0,0,0\n"
                                 "40 delay 1500\n50 print speed\n";
constexpr std::string_view raw_for_ever = "10 raw 1,200,1,100\n20 delay 50000\n";
constexpr std::string_view roll_for_ever = "10 goroll 0,60,1\n20 delay 50000\n";

constexpr std::string_view raw_and_rolls =
    "10 goroll 0,60,1\n20 delay 500\n30 raw 1,200,2,200\n40 delay 700\n50 ctrl = 1\n"
    "60 goroll 90,80,1\n70 delay 600\n80 ctrl = 0\n90 delay 300\n100 raw 2,255,2,255\n"
    "110 delay 900\n";

/// Records commands to the robot.
struct Recorder : vm::Observer {
  void on_event(Instant, const vm::Event& event) override {
    if (const auto* led = std::get_if<vm::event::Led>(&event))
      colors.push_back(led->color);
  }
  std::vector<vm::Color> colors;
};

struct Robot : Recorder, test::FarRobot {
  explicit Robot(spec::Robot which, std::string_view plan = "seed=1")
      : FarRobot(which, *protocol::parse_fault_plan(plan), 10ms, this) {}
};

struct Heard final : Listener {
  void on_event(Duration, const vm::Event& event) override {
    if (const auto* print = std::get_if<vm::event::Print>(&event))
      prints += print->text;
    if (const auto* drive = std::get_if<vm::event::Drive>(&event))
      rolls.push_back(drive->roll);
    if (const auto* blow = std::get_if<vm::event::Collision>(&event))
      blows.push_back(*blow);
  }
  void on_fault(Duration, const ProgramError&) override { ++faults; }
  std::string prints;
  std::vector<vm::Roll> rolls;
  std::vector<vm::event::Collision> blows;
  int faults = 0;
};

tl::expected<TetheredEnding, Failure> run_over(protocol::Transport& link, spec::Robot which,
                                               std::string_view program, Heard& heard) {
  const auto inputs = test::program_of(program);
  TetherOptions options;
  options.robot = which;
  return run_tethered(inputs, {}, heard, nullptr, link, options);
}

tl::expected<TetheredEnding, Failure> run_on(Robot& robot, spec::Robot which,
                                             std::string_view program, Heard& heard) {
  return run_over(*robot.link, which, program, heard);
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
    EXPECT_FALSE(robot.drives()) << row.name;
    EXPECT_EQ(robot.colors.front().red, 255) << row.name;
    EXPECT_EQ(robot.ball->led(), vm::Color{}) << row.name << " is left shining";
  }
}

TEST(Tether, RawMotorsThatAreOffAreOff) {
  for (const auto& row : spec::robots) {
    Options options;
    options.model = row.robot;
    Heard here;
    ASSERT_TRUE(run(test::program_of(raw), options, here, nullptr).has_value());
    Robot robot(row.robot);
    Heard there;
    const auto driven = run_on(robot, row.robot, raw, there);
    ASSERT_TRUE(driven.has_value()) << row.name;
    EXPECT_NEAR(std::stoi(there.prints), std::stoi(here.prints), 8) << row.name;
    EXPECT_FALSE(robot.drives()) << row.name;
  }
}

TEST(Tether, RawMotorsGoOffHoweverARunEnds) {
  for (const auto& row : spec::robots) {
    Robot robot(row.robot);
    test::InterruptedLink link(*robot.link, robot.link->now() + 3s);
    Heard heard;
    const auto driven = run_over(link, row.robot, raw_for_ever, heard);
    ASSERT_TRUE(driven && driven->failure) << row.name;
    EXPECT_EQ(driven->failure->code, ExitCode::Interrupted) << row.name;
    EXPECT_TRUE(driven->ending.robot_stopped.value_or(false)) << row.name;
    EXPECT_FALSE(robot.drives()) << row.name << " is left driving";
    EXPECT_TRUE(robot.ball->body().stabilized()) << row.name;
  }
}

/// A listener that throws at the first drive command.
struct Broken final : Listener {
  void on_event(Duration, const vm::Event& event) override {
    broken = broken || std::holds_alternative<vm::event::Drive>(event);
    if (broken)
      throw std::runtime_error("a vase fell");
  }
  void on_fault(Duration, const ProgramError&) override {}
  bool broken = false;
};

TEST(Tether, ABugStopsTheRobotBeforeItIsTold) {
  for (const auto& row : spec::robots) {
    Robot robot(row.robot);
    Broken heard;
    TetherOptions options;
    options.robot = row.robot;
    const auto driven =
        run_tethered(test::program_of(roll_for_ever), {}, heard, nullptr, *robot.link, options);
    ASSERT_TRUE(driven && driven->failure) << row.name;
    EXPECT_EQ(driven->failure->code, ExitCode::Bug) << row.name;
    EXPECT_TRUE(driven->ending.robot_stopped.value_or(false)) << row.name;
    EXPECT_FALSE(robot.drives()) << row.name << " is left driving";
  }
}

TEST(Tether, IsStoppedWhereWhoeverHearsItStopThrows) {
  for (const auto& row : spec::robots) {
    // Samples arrive before the answers to the stop.
    test::FarRobot robot(row.robot, *protocol::parse_fault_plan("seed=1"), 300ms);
    {
      Tether tether(*robot.link, row.robot, TetherBudgets{});
      ASSERT_TRUE(tether.begin(Aim::Zero)) << row.name;
      tether.obey(vm::Motors{{vm::MotorMode::Forward, 120}, {vm::MotorMode::Forward, 120}});
      for (const auto end = tether.now() + 1s; tether.now() < end;)
        ASSERT_TRUE(tether.pump(end, [](const RobotMessage&) {})) << row.name;
      EXPECT_TRUE(robot.drives()) << row.name;
      EXPECT_THROW(
          tether.finish([](const RobotMessage&) { throw std::runtime_error("a vase fell"); }),
          std::runtime_error)
          << row.name;
    }
    EXPECT_FALSE(robot.drives()) << row.name << " is left driving";
    EXPECT_TRUE(robot.ball->body().stabilized()) << row.name;
  }
}

TEST(Tether, ARobotWithoutSamplesIsStoppedAfterHalfASecond) {
  for (const auto program : {raw_for_ever, roll_for_ever})
    for (const auto& row : spec::robots) {
      Robot robot(row.robot);
      test::MuteLink link(*robot.link, robot.link->now() + 3s);
      Heard heard;
      const auto driven = run_over(link, row.robot, program, heard);
      ASSERT_TRUE(driven && driven->failure) << row.name;
      EXPECT_EQ(driven->failure->code, ExitCode::LinkLost) << row.name;
      ASSERT_TRUE(link.stopped) << row.name;
      const auto wait = *link.stopped - *link.last_sample;
      EXPECT_GE(wait, 450ms) << row.name;
      EXPECT_LE(wait, 900ms) << row.name; // plus up to three commands, each at its interval
      EXPECT_FALSE(robot.drives()) << row.name;
    }
}

TEST(Tether, APauseOfTheComputerPausesTheProgram) {
  const auto drive = [](spec::Robot which, Duration pause, Duration& lasted) {
    Robot robot(which);
    test::SleepingLink link(*robot.link, robot.link->now() + 3s, pause);
    Heard heard;
    const auto driven = run_over(link, which, square, heard);
    EXPECT_TRUE(driven && !driven->failure);
    if (driven)
      lasted = driven->ending.lasted;
    return link.rolls;
  };
  for (const auto which : {spec::Robot::Sphero, spec::Robot::Bolt}) {
    Duration awake{}, slept{};
    EXPECT_EQ(drive(which, 0s, awake), drive(which, 4s, slept));
    EXPECT_LT(std::chrono::abs(awake - slept), 200ms);
  }
}

TEST(Tether, ARobotThatIsAlwaysBusyIsARefusal) {
  constexpr std::string_view short_roll = "10 goroll 0,60,1\n20 delay 300\n";
  for (const auto which : {spec::Robot::Sphero, spec::Robot::Bolt})
    for (const int least_speed : {0, 1}) // with and without accepting the stop
      for (const auto program : {square, raw, short_roll}) {
        if (program == raw && least_speed == 1)
          continue; // switching raw motors off is not a roll
        Robot robot(which);
        test::BusyLink link(*robot.link, least_speed);
        Heard heard;
        const auto driven = run_over(link, which, program, heard);
        ASSERT_TRUE(driven && driven->failure) << program;
        EXPECT_EQ(driven->failure->code, ExitCode::Refused);
        EXPECT_NE(driven->failure->message.find("busy"), std::string::npos)
            << driven->failure->message;
      }
}

/// However the run ends, no motor turns longer than 2.1 s, and none at all if the stop was
/// acknowledged.
void expect_stopped(Robot& robot, const tl::expected<TetheredEnding, Failure>& driven,
                    const std::string& words) {
  if (driven && driven->ending.robot_stopped.value_or(false)) {
    EXPECT_FALSE(robot.drives()) << words << " is left driving";
    return;
  }
  robot.live_on(2100ms); // it stops by itself within two seconds after the last command
  EXPECT_FALSE(robot.drives()) << words << " is left driving";
}

TEST(Tether, LeavesNoRobotDrivingWhateverTheLinkDoes) {
  constexpr std::string_view plans[] = {"drop=10%",      "dup=10%",       "flip=5%",
                                        "split,drop=2%", "merge,stale=8", "delay=50..300ms",
                                        "storm=30%",     "cut@300",       "cut-answer@1500"};
  for (const auto& row : spec::robots)
    for (const auto plan : plans)
      for (const auto program : {square, raw_and_rolls, raw_for_ever})
        for (int seed = 1; seed <= 3; ++seed) {
          const auto words = fmt::format("{} {},seed={}, {}", row.name, plan, seed, program);
          Robot robot(row.robot, fmt::format("{},seed={}", plan, seed));
          test::InterruptedLink link(*robot.link,
                                     robot.link->now() + (program == square ? 60s : seed * 1s));
          Heard heard;
          expect_stopped(robot, run_over(link, row.robot, program, heard), words);
        }
}

TEST(Tether, ARobotThatIsHeldStandsStillAndGoesOnAsItDrove) {
  for (const auto& row : spec::robots) {
    const auto drive = [&](const vm::Motion& motion) {
      Robot robot(row.robot);
      TetherOptions options;
      options.robot = row.robot;
      auto held = hold_robot(*robot.link, options);
      ASSERT_TRUE(held) << row.name;
      ASSERT_TRUE((*held)->go_on(0s)) << row.name;
      (*held)->obey(motion);
      const auto live = [&](Duration until) {
        while ((*held)->time() < until)
          ASSERT_TRUE((*held)->hear(until)) << row.name;
      };
      live(1s);
      EXPECT_TRUE(robot.drives()) << row.name;
      ASSERT_TRUE((*held)->hold()) << row.name;
      EXPECT_FALSE(robot.drives()) << row.name << " drives while it is held";
      robot.live_on(5s);
      ASSERT_TRUE((*held)->go_on(1s)) << row.name;
      live(2s);
      EXPECT_TRUE(robot.drives()) << row.name << " does not go on";
      EXPECT_EQ(robot.ball->body().stabilized(), std::holds_alternative<vm::Roll>(motion));
      held->reset();
      EXPECT_FALSE(robot.drives()) << row.name << " is left driving";
    };
    drive(vm::Roll{90, 60, vm::Go::Drive});
    drive(vm::Motors{{vm::MotorMode::Forward, 200}, {vm::MotorMode::Ignore, 0}});
  }
}

TEST(Tether, WhoeverHoldsTheLinkCanStopItsRobot) {
  for (const auto& row : spec::robots)
    for (const vm::Motion& motion :
         {vm::Motion(vm::Roll{90, 60, vm::Go::Drive}),
          vm::Motion(vm::Motors{{vm::MotorMode::Forward, 200}, {vm::MotorMode::Forward, 200}})}) {
      Robot robot(row.robot);
      Tether tether(*robot.link, row.robot, {});
      ASSERT_TRUE(tether.begin(Aim::Zero)) << row.name;
      tether.obey(motion);
      for (const auto until = tether.now() + 1s; tether.now() < until;)
        ASSERT_TRUE(tether.pump(until, [](const RobotMessage&) {})) << row.name;
      EXPECT_TRUE(robot.drives()) << row.name;
      ASSERT_TRUE(robot.link->write(tether.stop_packets())) << row.name;
      for (const auto until = robot.link->now() + 300ms; robot.link->now() < until;)
        ASSERT_TRUE(robot.link->read(until)) << row.name;
      EXPECT_FALSE(robot.drives()) << row.name << " is left driving";
      EXPECT_TRUE(robot.ball->body().stabilized()) << row.name;
    }
}

TEST(Tether, AMotorThatIsIgnoredGoesOn) {
  Robot robot(spec::Robot::Mini);
  Heard heard;
  const auto driven = run_on(robot, spec::Robot::Mini,
                             "10 raw 1,100,1,100\n20 delay 300\n30 raw 0,0,4,0\n40 delay 250\n"
                             "50 print yaw\n60 ctrl = 1\n70 delay 300\n80 goroll 90,60,1\n"
                             "90 delay 800\n100 print speed\n",
                             heard);
  ASSERT_TRUE(driven && !driven->failure);
  ASSERT_EQ(heard.faults, 0);
  int yaw = 0, speed = 0;
  ASSERT_EQ(std::sscanf(heard.prints.c_str(), "%d %d", &yaw, &speed), 2) << heard.prints;
  EXPECT_GT(yaw, 180) << "the right wheel went on: it turned to the left";
  EXPECT_GT(speed, 10) << "and rolls again";
}

TEST(Tether, WhatWasLostBeforeAStopDoesNotComeBackAfterIt) {
  for (const auto which : {spec::Robot::Sphero, spec::Robot::Mini}) {
    Robot robot(which);
    test::LosingLink link(*robot.link);
    Heard heard;
    const auto driven =
        run_over(link, which,
                 "10 delay 500\n20 ctrl = 0\n30 delay 150\n40 ctrl = 1\n50 delay 1500\n"
                 "60 goroll 0,90,1\n70 delay 1500\n",
                 heard);
    ASSERT_TRUE(driven && !driven->failure);
    ASSERT_TRUE(link.lost);
    EXPECT_TRUE(robot.ball->body().stabilized());
    EXPECT_EQ(heard.faults, 0);
    EXPECT_GT(driven->ending.sight.pose.y_cm, 20) << "it did not roll";
  }
}

TEST(Tether, AStopThatIsWantedAgainAndAgainComesToItsEnd) {
  for (const auto& row : spec::robots) {
    Robot robot(row.robot);
    Heard heard;
    Options bounds;
    bounds.bound = 6s;
    const auto inputs = test::program_of("10 raw 1,100,1,100\n20 delay 1000\n30 ctrl = 1\n"
                                         "40 goroll 90,80,1\n50 delay 5\n60 goto 30\n");
    TetherOptions options;
    options.robot = row.robot;
    const auto driven = run_tethered(inputs, bounds, heard, nullptr, *robot.link, options);
    ASSERT_TRUE(driven && !driven->failure) << row.name;
    EXPECT_GT(driven->ending.sight.pose.x_cm, 30) << row.name << " never rolled";
  }
}

TEST(Tether, AMotorThatWasSwitchedOffStaysOff) {
  Robot robot(spec::Robot::Mini);
  Heard heard;
  const auto driven = run_on(robot, spec::Robot::Mini,
                             "10 raw 1,120,1,120\n20 delay 300\n30 ctrl = 1\n40 delay 900\n"
                             "50 raw 4,0,1,60\n60 delay 500\n70 print yaw\n",
                             heard);
  ASSERT_TRUE(driven && !driven->failure);
  EXPECT_GT(std::stoi(heard.prints), 180) << "only the right wheel drives: it turns to the left";
}

/// Applies a line of a stimulus script.
void happens(Robot& robot, const std::string& line) {
  const Source source("test", line);
  const auto script = vm::parse_stimulus(source);
  ASSERT_TRUE(script.diagnostics.empty()) << line;
  robot.ball->schedule(script.events);
}

TEST(Tether, EachRobotReportsTheWallItRunsInto) {
  for (const auto& row : spec::robots) {
    Robot robot(row.robot);
    happens(robot, "at 0s wall y=30");
    Heard heard;
    const auto driven = run_on(robot, row.robot, "10 goroll 0,40,1\n20 delay 5000\n", heard);
    ASSERT_TRUE(driven && !driven->failure) << row.name;
    if (row.sensors == spec::RobotSensors::Services) // it detects no collisions
      continue;
    EXPECT_GE(heard.blows.size(), 1U) << row.name;
    if (!heard.blows.empty()) {
      EXPECT_EQ(heard.blows.front().axis, 2) << row.name;
      EXPECT_GT(heard.blows.front().y_magnitude, 10) << row.name;
    }
  }
}

TEST(Tether, ADoubleShakeIsToldFromTheSamples) {
  for (const auto which : {spec::Robot::Sphero, spec::Robot::Mini, spec::Robot::Rvr}) {
    const auto shaken = [&](std::string_view what) {
      Robot robot(which);
      happens(robot, fmt::format("at 3s {}", what));
      Heard heard;
      run_on(robot, which,
             "10 for I = 1 to 90\n20 delay 50\n30 if dshake > 0 then print \"shaken\"\n"
             "40 next I\n50 print accelone > 900\n",
             heard);
      return heard.prints;
    };
    EXPECT_NE(shaken("shake").find("shaken"), std::string::npos) << spec::info(which).name;
    EXPECT_EQ(shaken("push 90 100").find("shaken"), std::string::npos) << spec::info(which).name;
  }
}

TEST(Tether, ItsBatteryIsItsOwn) {
  for (const auto& row : spec::robots) {
    Robot robot(row.robot);
    Heard heard;
    const auto driven =
        run_on(robot, row.robot, "10 delay 200\n20 print Vbatt\n30 print Sbatt\n", heard);
    ASSERT_TRUE(driven && !driven->failure) << row.name;
    int volts = 0, state = 0;
    ASSERT_EQ(std::sscanf(heard.prints.c_str(), "%d %d", &volts, &state), 2) << heard.prints;
    EXPECT_NEAR(volts, 100 * spec::battery(row.robot).full, 5) << row.name;
    EXPECT_EQ(state, 2) << row.name << " is low";
  }
}

TEST(Tether, ARobotThatIsAboutToSleepIsKeptAwake) {
  Robot robot(spec::Robot::Rvr);
  Heard heard;
  const auto inputs = test::program_of("10 delay 32000\n15 delay 32000\n20 goto 10\n");
  TetherOptions options;
  options.robot = spec::Robot::Rvr;
  options.budgets.battery = 24h; // no other request
  Options bounds;
  bounds.bound = 700s;
  const auto driven = run_tethered(inputs, bounds, heard, nullptr, *robot.link, options);
  ASSERT_TRUE(driven.has_value());
  EXPECT_FALSE(driven->failure) << driven->failure->message;
}

TEST(Tether, AnyBytesFromARobotAreNoValueOfTheProgram) {
  for (const auto& row : spec::robots)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Robot robot(row.robot);
      test::BabblingLink link(*robot.link, seed, row);
      Heard heard;
      const auto driven = run_over(
          link, row.robot,
          "10 goroll 90,60,1\n20 for I = 1 to 40\n30 delay 50\n"
          "40 if abs(xpos) > 2000 then print \"far\"\n50 if speed > 255 then print \"fast\"\n"
          "60 next I\n",
          heard);
      EXPECT_EQ(heard.prints, "") << row.name << " " << seed;
      expect_stopped(robot, driven, std::string(row.name));
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
