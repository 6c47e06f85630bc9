#include "base/utf8.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(Utf8, LengthsOfCodePoints) {
  EXPECT_EQ(utf8_length("a"), 1U);
  EXPECT_EQ(utf8_length("é"), 2U);
  EXPECT_EQ(utf8_length("€"), 3U);
  EXPECT_EQ(utf8_length("😀"), 4U);
}

TEST(Utf8, OverlongFormsSurrogatesAndStraysAreNotUtf8) {
  for (const auto* bytes : {"\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                            "\xF5\x80\x80\x80", "\xE2\x82", "\xC3("})
    EXPECT_EQ(utf8_length(bytes), 0U) << bytes;
}

TEST(Utf8, EachBadByteCountsAsOneReplacement) {
  EXPECT_EQ(code_points("a\xFF\xE2\x82z"), 5U);
  EXPECT_EQ(to_valid_utf8("a\xFF"), "a\xEF\xBF\xBD");
}

TEST(Utf8, NoEscapeSequenceReachesTheTerminal) {
  EXPECT_EQ(to_printable("a\x1b[31m\tb"), "a\xEF\xBF\xBD[31m b");
  EXPECT_EQ(to_printable("\xC2\x9B"), "\xEF\xBF\xBD"); // CSI as a C1 control
}

} // namespace
} // namespace orb
