#include "spec/edu.h"

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <string_view>

namespace orb::spec {
namespace {

TEST(Edu, EveryNameStandsForOneCall) {
  std::set<std::string_view> names;
  for (const auto& row : edu_calls) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(&info(row.call), &row) << row.name;
    EXPECT_EQ(find_edu_call(row.name), &row);
    EXPECT_FALSE(row.summary.empty()) << row.name;
    EXPECT_NE(row.robots, 0U) << row.name;
  }
  for (const auto& row : edu_objects)
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
  EXPECT_EQ(find_edu_call("rol"), nullptr);
}

TEST(Edu, AnExampleCallsWhatItShowsAndAwaitsWhatTakesTime) {
  for (const auto& row : edu_calls) {
    const std::string call = std::string(row.name) + "(";
    const auto at = row.example.find(call);
    ASSERT_NE(at, std::string_view::npos) << row.name;
    EXPECT_EQ(row.example.starts_with("await "), row.kind == EduKind::Awaited) << row.example;
  }
}

TEST(Edu, OperandsStandBehindEachOtherAndHaveARange) {
  EduCall last = edu_operands.front().call;
  EduPresence presence = EduPresence::Required;
  for (const auto& operand : edu_operands) {
    if (operand.call != last)
      presence = EduPresence::Required;
    EXPECT_GE(static_cast<int>(operand.call), static_cast<int>(last)) << operand.name;
    EXPECT_GE(static_cast<int>(operand.presence), static_cast<int>(presence))
        << info(operand.call).name;
    EXPECT_LE(operand.least, operand.most) << info(operand.call).name;
    last = operand.call;
    presence = operand.presence;
  }
}

TEST(Edu, OldNamesLeadToOnesThatAre) {
  for (const auto& row : edu_old_names) {
    EXPECT_NE(find_edu_call(row.now), nullptr) << row.name;
    EXPECT_EQ(find_edu_call(row.name), nullptr) << row.name;
  }
}

TEST(Edu, LampsAreThoseOfTheRobotsThatHaveTheCall) {
  for (const auto& row : edu_lamps) {
    EXPECT_EQ(row.robots & ~info(row.call).robots, 0U) << info(row.call).name;
    EXPECT_NE(row.mask, 0U);
  }
  EXPECT_EQ(edu_lamps_of(EduCall::SetBackLed, Robot::Bolt), info(Robot::Bolt).aiming);
  EXPECT_EQ(edu_lamps_of(EduCall::SetBackLed, Robot::R2d2), info(Robot::R2d2).aiming);
  EXPECT_EQ(edu_lamps_of(EduCall::SetBackLed, Robot::Mini), 0U);
}

} // namespace
} // namespace orb::spec
