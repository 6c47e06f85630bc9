#include "base/text/text.h"

#include <charconv>
#include <cstdint>
#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(Text, WordsAreEqualInCapitalsOrNot) {
  EXPECT_TRUE(equal_words("RGB", "rgb"));
  EXPECT_FALSE(equal_words("rgb", "rg"));
  EXPECT_FALSE(equal_words("@", "`")) << "only letters have capitals";
}

TEST(Text, BlanksAtTheEndsGo) {
  EXPECT_EQ(trim(" \tgo to \t"), "go to");
  EXPECT_EQ(trim("  "), "");
}

TEST(Text, ANumberIsTheWholeText) {
  EXPECT_EQ(parse_number<std::uint8_t>("255"), 255);
  EXPECT_EQ(parse_number<std::int32_t>("-7"), -7);
  EXPECT_EQ(parse_number<unsigned>("ff", 16), 255U);
  EXPECT_EQ(parse_number<double>("-.5e1"), -5);
  for (const auto* text : {"", "-", ".", "inf", "nan", "0x1p3", "1e", "1e+", "+1", "1 ", "1e999"})
    EXPECT_EQ(parse_number<double>(text), std::nullopt) << text;
  EXPECT_EQ(parse_number<double>("1e3", std::chars_format::fixed), std::nullopt);
  EXPECT_EQ(parse_number<double>("2.5", std::chars_format::fixed), 2.5);
  for (const auto* text : {"", "256", "1 ", " 1", "+1", "1x", "-1"})
    EXPECT_EQ(parse_number<std::uint8_t>(text), std::nullopt) << text;
}

} // namespace
} // namespace orb
