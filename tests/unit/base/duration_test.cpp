#include "base/duration.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(ParseDuration, ReadsEveryUnitExactly) {
  EXPECT_EQ(parse_duration("250ms"), 250ms);
  EXPECT_EQ(parse_duration("2.5s"), 2500ms);
  EXPECT_EQ(parse_duration("2min"), 2min);
  EXPECT_EQ(parse_duration("1h"), 1h);
  EXPECT_EQ(parse_duration("0.1s"), 100ms); // no binary fraction
  EXPECT_EQ(parse_duration("0.000000001s"), 1ns);
  EXPECT_EQ(parse_duration("0ms"), 0ms);
}

TEST(ParseDuration, CountsABareNumberInTheGivenUnit) {
  EXPECT_EQ(parse_duration("2", 1s), 2s);
  EXPECT_EQ(parse_duration("1.5", 1ms), 1500us);
  EXPECT_FALSE(parse_duration("2"));
}

TEST(ParseDuration, RefusesWhatIsNoTime) {
  for (const auto* text : {"", "s", "ms", "-1s", "+1s", "1 s", "1..5s", "1,5s", "1e3s", "1d", ".5s",
                           "0x10s", "9000h", "99999999999999999999s"})
    EXPECT_FALSE(parse_duration(text)) << text;
}

} // namespace
} // namespace orb
