#include "base/text/suggest.h"

#include <array>
#include <gtest/gtest.h>

namespace orb {
namespace {

using namespace std::string_view_literals;

constexpr std::array words = {"goto"sv, "gosub"sv, "goroll"sv, "RGB"sv, "random"sv, "rnd"sv};

TEST(Closest, PrefersTheSameLettersInAnotherCase) {
  EXPECT_EQ(closest("rgb", words), "RGB");
  EXPECT_EQ(closest("GOTO", words), "goto");
}

TEST(Closest, FindsTheLeastEditDistance) {
  EXPECT_EQ(closest("gorol", words), "goroll");
  EXPECT_EQ(closest("gsoub", words), "gosub");
  EXPECT_EQ(closest("radnom", words), "random");
}

TEST(Closest, SaysNothingWhereNothingIsNear) {
  EXPECT_EQ(closest("teleport", words), std::nullopt);
  EXPECT_EQ(closest("x", words), std::nullopt);
  EXPECT_EQ(closest("", words), std::nullopt);
  EXPECT_EQ(closest(std::string(100000, 'g'), words), std::nullopt);
}

TEST(Closest, ASingleLetterIsNotTurnedIntoAnother) {
  constexpr std::array letters = {"A"sv, "B"sv};
  EXPECT_EQ(closest("x", letters), std::nullopt);
  EXPECT_EQ(closest("b", letters), "B");
}

} // namespace
} // namespace orb
