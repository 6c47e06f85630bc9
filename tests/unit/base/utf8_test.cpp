#include "base/text/utf8.h"

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

TEST(Utf8, LetsOnlyOurOwnSequencesThroughToATerminal) {
  const std::string own = "\r\x1b[K\x1b[1;31merror\x1b[0m:\tü\n";
  EXPECT_EQ(to_terminal_text(own), own);
  for (const auto* bad :
       {"\x1b]0;title\x07", "\x1b[2J", "\x1b[1K", "\x1b[6n", "\x1b", "\x1b[", "\x1b[1;",
        "\xC2\x9B"
        "2J",
        "\x9B"
        "2J",
        "\x7F", "\x08"}) {
    const auto shown = to_terminal_text(bad);
    EXPECT_EQ(shown.find_first_of("\x1b\x07\x08\x7F"), std::string::npos);
    EXPECT_EQ(shown.find("\xC2\x9B"), std::string::npos);
    EXPECT_EQ(to_valid_utf8(shown), shown);
  }
}

TEST(ShownName, StaysOnItsLineAndIsNoCommandOfACi) {
  EXPECT_EQ(shown_name("größe 1.bas"), "größe 1.bas");
  EXPECT_EQ(shown_name("a\n\r\t\x1B\x7F"), "a\\n\\r\\t\\x1B\\x7F");
  EXPECT_EQ(shown_name("::stop::x"), "./::stop::x");
  EXPECT_EQ(shown_name("  ::stop::x"), "./  ::stop::x");
  EXPECT_EQ(shown_name("a::stop::x"), "a::stop::x");
  EXPECT_EQ(shown_name(""), "");
}

} // namespace
} // namespace orb
