#include "base/bytes.h"

#include <gtest/gtest.h>

namespace orb {
namespace {

TEST(Bytes, NumbersTravelMostSignificantByteFirst) {
  Bytes bytes;
  append_u32(bytes, 0x22780041);
  append_u16(bytes, 0x0240);
  EXPECT_EQ(bytes, (Bytes{0x22, 0x78, 0x00, 0x41, 0x02, 0x40}));
  EXPECT_EQ(read_u32(bytes, 0), 0x22780041U);
  EXPECT_EQ(read_u16(bytes, 4), 0x0240U);
}

TEST(Bytes, HexIsPrintedAndReadBack) {
  const Bytes bytes{0xFF, 0x14, 0x00};
  EXPECT_EQ(to_hex(bytes), "FF 14 00");
  EXPECT_EQ(from_hex("FF 14 00"), bytes);
  EXPECT_EQ(from_hex("ff1400\n"), bytes);
  EXPECT_EQ(from_hex("0xFF, 0x14,\t0x00"), bytes);
  EXPECT_EQ(from_hex(""), Bytes{});
}

TEST(Bytes, WhatIsNoHexIsRefused) {
  EXPECT_EQ(from_hex("FF 1"), std::nullopt);
  EXPECT_EQ(from_hex("F F"), std::nullopt);
  EXPECT_EQ(from_hex("GG"), std::nullopt);
}

} // namespace
} // namespace orb
