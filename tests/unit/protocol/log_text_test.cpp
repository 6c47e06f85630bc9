#include "protocol/log_text.h"

#include <gtest/gtest.h>
#include <optional>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

constexpr auto out = Direction::ToBall;
constexpr auto in = Direction::FromBall;

TEST(LogText, FindsTimeDirectionAndBytes) {
  struct {
    const char* line;
    const char* when;
    std::optional<Direction> direction;
    const char* bytes;
  } const rows[] = {
      {"> FF FF 00 01 52 01 AB", "", out, "FF FF 00 01 52 01 AB"},
      {"< FF", "", in, "FF"},
      {"1.234 > FF FF", "1.234", out, "FF FF"},
      {"12:00:01.234 < FF FF 00", "12:00:01.234", in, "FF FF 00"},
      {"12:00:01 FF FF 00 01 52 01 AB", "12:00:01", std::nullopt, "FF FF 00 01 52 01 AB"},
      {"[0.123] TX: 8d 0a 13 0d 00 d5 d8", "0.123", out, "8D 0A 13 0D 00 D5 D8"},
      {"[0.123] rx 8d0a130d00d5d8", "0.123", in, "8D 0A 13 0D 00 D5 D8"},
      {"2026-11-29 12:00:00 -> ff:ff:00:01:52:01:ab", "2026-11-29 12:00:00", out,
       "FF FF 00 01 52 01 AB"},
      {"\u2190 [0x8d, 0x09, 0x13]", "", in, "8D 09 13"},
      {"request 0x8d 0xa 0x13", "", out, "8D 0A 13"},
      {"DEBUG:bleak:Received: bytearray(b'\\x8d\\n\\x13\\r\\'\\\\A\\x00')", "", in,
       "8D 0A 13 0D 27 5C 41 00"},
      {"sent 7 bytes: 8d 0a 13 0d 00 d5 d8 (wake)", "", out, "8D 0A 13 0D 00 D5 D8"},
      {"0.5 ball 68:86:E7:00:11:22 said 8d 0a 13 0d 00 d5 d8", "0.5", in, "8D 0A 13 0D 00 D5 D8"},
  };
  for (const auto& row : rows) {
    const auto log = read_log(row.line);
    ASSERT_EQ(log.lines.size(), 1U) << row.line;
    EXPECT_EQ(log.lines[0].when, row.when) << row.line;
    EXPECT_EQ(log.lines[0].direction, row.direction) << row.line;
    EXPECT_EQ(to_hex(log.lines[0].bytes), row.bytes) << row.line;
    EXPECT_EQ(log.strangers, 0U) << row.line;
  }
}

TEST(LogText, CountsWhatHoldsNoBytes) {
  const auto log =
      read_log("\xEF\xBB\xBF# a log\r\n\r\n> FF FF\r\nconnected to 68:86:E7:00:11:22\r\n"
               "12 apples\nread 12 apples\n12:00:01\n> FF F\n> zz\n");
  EXPECT_EQ(log.lines.size(), 1U);
  EXPECT_EQ(log.read_lines, 7U);
  EXPECT_EQ(log.strangers, 6U);
  EXPECT_EQ(log.first_stranger, 4U);
  EXPECT_EQ(log.stranger, "connected to 68:86:E7:00:11:22");
}

RC_GTEST_PROP(LogText, ReadsAnyText, (std::string text)) {
  const auto log = read_log(text);
  RC_ASSERT(log.lines.size() + log.strangers == log.read_lines);
}

} // namespace
} // namespace orb::protocol
