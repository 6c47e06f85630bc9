#include "base/source.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(Source, EndsLinesAtLfCrAndCrLf) {
  const Source source("a.bas", "one\ntwo\rthree\r\nfour");
  EXPECT_EQ(source.line_count(), 4U);
  EXPECT_EQ(source.line(1), "one");
  EXPECT_EQ(source.line(2), "two");
  EXPECT_EQ(source.line(3), "three");
  EXPECT_EQ(source.line(4), "four");
  EXPECT_EQ(source.line(5), "");
}

TEST(Source, CountsLinesAndColumnsFromOne) {
  const Source source("a.bas", "one\ntwo\n");
  EXPECT_EQ(source.position(0), (Position{1, 1}));
  EXPECT_EQ(source.position(4), (Position{2, 1}));
  EXPECT_EQ(source.position(6), (Position{2, 3}));
  EXPECT_EQ(source.position(8), (Position{3, 1}));
  EXPECT_EQ(source.position(99), (Position{3, 1}));
}

} // namespace
} // namespace orb
