#include "uploader/ble.h"

#include "compiler/load.h"
#include "tests/fakes/gatt_ball.h"
#include "uploader/upload.h"
#include "vm/ball.h"
#include "vm/ball_transport.h"

#include <gtest/gtest.h>
#include <vector>

namespace orb::uploader {
namespace {

using protocol::BleFaultPlan;
using protocol::BleStep;

constexpr auto interval = Duration(30ms);

/// A ball behind a GATT, and the steps reported.
struct Robot {
  explicit Robot(
      const BleFaultPlan& plan = {}, const StopRequests& stop = [] { return 0; },
      const std::string& name = "SK-0001") {
    vm::BallOptions options;
    options.loader = compiler::load;
    ball = std::make_unique<vm::Ball>(options);
    auto made = std::make_unique<test::GattBall>(std::make_unique<vm::BallTransport>(*ball), plan,
                                                 interval);
    gatt = made.get();
    gatt->advertised = name;
    auto opened = open_ble(
        std::move(made), ble_budgets({}), stop,
        [&](BleStep step, const auto& found) {
          told.push_back(step);
          if (!found)
            error = found.error();
        },
        [&](const BlePeer& met) { peer = met; });
    if (opened)
      link = *std::move(opened);
    else
      gatt = nullptr;
  }

  std::unique_ptr<vm::Ball> ball;
  test::GattBall* gatt = nullptr;
  std::unique_ptr<protocol::Transport> link;
  std::vector<BleStep> told;
  std::optional<BleError> error;
  std::optional<BlePeer> peer;
};

TEST(Ble, WritesTheWordsOfTheTableInTheirOrderBeforeAnythingElse) {
  const Robot robot;
  ASSERT_TRUE(robot.link);
  EXPECT_EQ(robot.gatt->greeting, "011i3|\x07|\x01|");
  ASSERT_EQ(robot.told.size(), protocol::ble_steps.size());
  for (std::size_t i = 0; i < robot.told.size(); ++i)
    EXPECT_EQ(robot.told[i], protocol::ble_steps[i].step);
}

TEST(Ble, ANewerRobotHearsItsOwnWord) {
  BleFaultPlan plan;
  plan.newer = true;
  const Robot robot(plan);
  ASSERT_TRUE(robot.link);
  EXPECT_EQ(robot.gatt->greeting, "usetheforce...band|");
}

TEST(Ble, NoPieceIsLongerThanARobotTakes) {
  Robot robot;
  ASSERT_TRUE(robot.link);
  Session session(*robot.link, ble_budgets({}), 0);
  const auto answer = session.exchange(
      spec::ApiCommand::AppendOrbbasicFragment,
      Bytes(200, 'x')); // the first byte is an invalid area, which still gets an answer
  EXPECT_TRUE(answer.has_value());
  EXPECT_EQ(robot.gatt->longest_piece, spec::ble_piece_bytes);
}

TEST(Ble, ALinkThatIsLostOnceIsOpenedAgain) {
  for (const auto& row : protocol::ble_steps) {
    if (row.step < BleStep::Connect)
      continue;
    BleFaultPlan plan;
    plan.drop_once = row.step;
    const Robot robot(plan);
    EXPECT_TRUE(robot.link) << row.word;
    EXPECT_FALSE(robot.error) << row.word;
  }
}

TEST(Ble, AStepThatFailsOnceIsTakenAgainOverALinkOfItsOwn) {
  for (const auto& row : protocol::ble_steps) {
    if (row.step < BleStep::Connect)
      continue;
    BleFaultPlan plan;
    plan.balk_once = row.step;
    const Robot robot(plan);
    EXPECT_TRUE(robot.link) << row.word;
  }
}

TEST(Ble, ALinkThatIsAlwaysLostIsGivenUpInTheStepThatLosesIt) {
  for (const auto& row : protocol::ble_steps) {
    BleFaultPlan plan;
    plan.drop = row.step;
    const Robot robot(plan);
    EXPECT_FALSE(robot.link) << row.word;
    ASSERT_TRUE(robot.error) << row.word;
    EXPECT_EQ(robot.error->failure, BleFailure::Lost) << row.word;
    EXPECT_EQ(robot.told.back(), row.step) << row.word;
    EXPECT_LE(robot.ball->now() - Instant{}, ble_budgets({}).open()) << row.word;
  }
}

TEST(Ble, ItIsToldWhoIsThere) {
  for (const bool newer : {false, true}) {
    BleFaultPlan plan;
    plan.newer = newer;
    const Robot robot(
        plan, [] { return 0; }, "SB-1A2B");
    ASSERT_TRUE(robot.peer);
    EXPECT_EQ(robot.peer->name, "SB-1A2B");
    EXPECT_EQ(robot.peer->protocol, newer ? spec::BleProtocol::V2 : spec::BleProtocol::V1);
  }
}

TEST(Ble, ARobotThatOrbDoesNotDriveIsNotConnected) {
  const Robot robot(
      {}, [] { return 0; }, "LM-1A2B");
  ASSERT_TRUE(robot.error);
  EXPECT_EQ(robot.error->failure, BleFailure::Undriven);
  EXPECT_EQ(robot.told.back(), BleStep::Find);
  EXPECT_NE(robot.error->seen.find("Lightning McQueen"), std::string::npos);
}

TEST(Ble, NobodyTriesAgainAfterARequestToStop) {
  BleFaultPlan plan;
  plan.drop = BleStep::Services;
  const Robot robot(plan, [] { return 1; });
  ASSERT_TRUE(robot.error);
  EXPECT_EQ(robot.told.back(), BleStep::Services);
  EXPECT_LT(robot.ball->now() - Instant{}, Duration(1s));
}

TEST(Ble, EveryFailureButAnInterruptionHasARemedy) {
  for (int i = 0; i < static_cast<int>(BleFailure::Interrupted); ++i)
    EXPECT_FALSE(remedy({static_cast<BleFailure>(i), {}}).empty()) << i;
}

TEST(Ble, ARemedyNamesTheRobotByItsAddress) {
  BleFaultPlan plan;
  plan.held = true;
  const Robot robot(plan);
  ASSERT_TRUE(robot.error);
  EXPECT_EQ(remedy(*robot.error), "close that program, or disconnect the robot with "
                                  "`bluetoothctl disconnect 68:86:E7:00:00:01`");
}

TEST(Ble, BudgetsCountPieces) {
  EXPECT_EQ(ble_budgets({}).pieces(20), 1U);
  EXPECT_EQ(ble_budgets({}).pieces(21), 2U);
  EXPECT_EQ(ble_budgets({}).pieces(260), 13U);
  EXPECT_EQ(Budgets{}.pieces(260), 1U);
  EXPECT_GT(ble_budgets({}).ask(), Budgets{}.ask());
}

} // namespace
} // namespace orb::uploader
