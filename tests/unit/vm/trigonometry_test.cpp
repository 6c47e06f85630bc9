#include "vm/body/trigonometry.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

namespace orb::vm {
namespace {

TEST(Trigonometry, IsThatOfTheCLibrary) {
  constexpr double allowed = 3e-16; // an ulp or two of a value up to 1
  for (int i = -200000; i <= 200000; ++i) {
    const double angle = i * 0.000737;
    ASSERT_NEAR(sine(angle), std::sin(angle), allowed) << angle;
    ASSERT_NEAR(cosine(angle), std::cos(angle), allowed) << angle;
  }
  for (const double far : {12345.678, -99999.5, 654321.25}) {
    EXPECT_NEAR(sine(far), std::sin(far), 1e-15);
    EXPECT_NEAR(cosine(far), std::cos(far), 1e-15);
  }
  for (int i = -3000; i <= 3000; ++i)
    ASSERT_NEAR(arctangent(i * 0.71, 980.665), std::atan2(i * 0.71, 980.665), 5e-16) << i;
  EXPECT_EQ(length(3, 4), 5);
}

TEST(Trigonometry, IsExactWhereHeadingsAre) {
  EXPECT_EQ(sine(0), 0);
  EXPECT_EQ(cosine(0), 1);
  EXPECT_EQ(arctangent(0, 1), 0);
}

// The last bits must not depend on compiler or C library.
TEST(Trigonometry, IsTheSameEverywhere) {
  double sum = 0;
  for (int i = 0; i < 10000; ++i)
    sum += sine(i * 0.37) * cosine(i * 1.13) + arctangent(i * 0.01, 7);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(sum), 4668451620881632589U);
}

} // namespace
} // namespace orb::vm
