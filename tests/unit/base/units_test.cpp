#include "base/units.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(Units, AreWholeStepsOfTheirMeasure) {
  EXPECT_EQ(unit::m.in(unit::cm), 100);
  EXPECT_EQ(unit::mm.in(unit::cm), 0.1);
  EXPECT_EQ(unit::in.in(unit::cm), 2.54);
  EXPECT_EQ(unit::yd.in(unit::cm), 91.44);
  EXPECT_EQ(unit::h.in(unit::s), 3600);
}

TEST(SplitAmount, TakesAPointOnlyBeforeADigit) {
  EXPECT_EQ(split_amount("-2.5cm/s").number, "-2.5");
  EXPECT_EQ(split_amount("-2.5cm/s").rest, "cm/s");
  EXPECT_EQ(split_amount("90..110cm").number, "90");
  EXPECT_EQ(split_amount("1.s").rest, ".s");
  EXPECT_EQ(split_amount(".5").number, "");
}

TEST(StepsOf, LosesNothing) {
  EXPECT_EQ(steps_of("0.000000001", unit::s.steps)->count, 1);
  EXPECT_EQ(steps_of("-1.05", unit::min.steps)->count, -63'000'000'000);
  EXPECT_TRUE(steps_of("1.5000000000000000000000", 1000)->exact);
  EXPECT_EQ(steps_of("0.0019", 1000)->count, 1);
  EXPECT_FALSE(steps_of("0.0019", 1000)->exact);
}

TEST(StepsOf, RefusesWhatIsNoNumberOrTooLarge) {
  for (const auto* text : {"", "-", "--1", "1.", ".5", "1cm", "1e3", " 1", "99999999999999999999"})
    EXPECT_FALSE(steps_of(text, 1)) << text;
  EXPECT_FALSE(steps_of("9999999999", unit::min.steps));
}

TEST(Hexadecimal, IsAtMostWhatFits) {
  EXPECT_EQ(hexadecimal("0x1F"), 31);
  EXPECT_EQ(hexadecimal("0XfFfFfFfFfFfFfFfFfF"), INT64_MAX);
  for (const auto* text : {"", "0x", "1F", "0x1G", "0x-1"})
    EXPECT_FALSE(hexadecimal(text)) << text;
}

TEST(ThousandthsText, IsAsShortAsItCanBe) {
  EXPECT_EQ(thousandths_text(2500), "2.5");
  EXPECT_EQ(thousandths_text(-500), "-0.5");
  EXPECT_EQ(thousandths_text(7000), "7");
}

} // namespace
} // namespace orb
