#include "protocol/describe_v2.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

std::vector<ItemV2> decode(const Bytes& bytes) {
  DecoderV2 decoder;
  decoder.feed(bytes);
  decoder.expire();
  std::vector<ItemV2> items;
  while (auto item = decoder.next())
    items.push_back(std::move(*item));
  return items;
}

TEST(PacketV2, EscapesTheThreeSpecialBytesAfterTheChecksum) {
  const PacketV2 packet{.flags = 0x0A, .did = 0x8D, .cid = 0xD8, .seq = 0xAB, .data = {}};
  // The sum 0A+8D+D8+AB is 21Ah; its low byte inverted is E5h.
  EXPECT_EQ(encode(packet), (Bytes{0x8D, 0x0A, 0xAB, 0x05, 0xAB, 0x50, 0xAB, 0x23, 0xE5, 0xD8}));
}

TEST(PacketV2, ReadsTargetSourceAndErrorWhereTheFlagsSaySo) {
  const auto items = decode(encode(PacketV2{.flags = 0x31,
                                            .target = 0x12,
                                            .source = 0x01,
                                            .did = 0x11,
                                            .cid = 0x06,
                                            .seq = 5,
                                            .error = 7,
                                            .data = {1, 2}}));
  ASSERT_EQ(items.size(), 1u);
  ASSERT_EQ(items[0].kind, ItemV2::Kind::Packet);
  EXPECT_EQ(DescriberV2{}.describe(items[0]),
            "response get-mac-address: flags 31 (response, target, source), tid 12 (port 1, node "
            "2), sid 01 (port 0, "
            "node 1), did 11, cid 06, seq 05, err 07 (bad parameter value), data 01 02, chk 95");
}

TEST(PacketV2, FindsPacketsAfterNoiseLostEndsAndBadChecksums) {
  auto stream = Bytes{0x00, 0x01};
  const auto good = encode(PacketV2{.flags = 2, .did = 1, .cid = 2, .seq = 3, .data = {}});
  stream.insert(stream.end(), good.begin(), good.end() - 1); // without its end
  stream.insert(stream.end(), good.begin(), good.end());
  auto damaged = good;
  damaged[2] ^= 4;
  stream.insert(stream.end(), damaged.begin(), damaged.end());
  stream.push_back(0x8D);
  const auto items = decode(stream);
  ASSERT_EQ(items.size(), 5u);
  EXPECT_EQ(items[0].kind, ItemV2::Kind::Noise);
  EXPECT_EQ(items[1].kind, ItemV2::Kind::Noise);
  EXPECT_EQ(items[2].kind, ItemV2::Kind::Packet);
  EXPECT_EQ(items[3].kind, ItemV2::Kind::BadChecksum);
  EXPECT_EQ(items[4].kind, ItemV2::Kind::Incomplete);
}

TEST(PacketV2, AnEscapeOfAnyOtherByteIsNoise) {
  // 2Bh with the bits 88h is also ABh, but only 23h is its escape.
  const auto items = decode({0x8D, 0x02, 0x01, 0x02, 0x03, 0xAB, 0x2B, 0x4C, 0xD8});
  ASSERT_EQ(items.size(), 1u);
  EXPECT_EQ(items[0].kind, ItemV2::Kind::Noise);
}

TEST(PacketV2, AnEndlessPacketIsGivenUp) {
  DecoderV2 decoder;
  const Bytes endless(spec::v2_max_packet + 1, spec::v2_start ^ 1);
  const Bytes start{spec::v2_start};
  decoder.feed(start);
  EXPECT_FALSE(decoder.next());
  decoder.feed(endless);
  const auto item = decoder.next();
  ASSERT_TRUE(item);
  EXPECT_EQ(item->kind, ItemV2::Kind::Noise);
}

RC_GTEST_PROP(PacketV2, ComesBackAsItWent, (std::uint8_t flags, const Bytes& data)) {
  PacketV2 packet;
  packet.flags = static_cast<std::uint8_t>(flags & 0x7F);
  packet.did = 0x8D;
  packet.cid = 0xAB;
  packet.seq = *rc::gen::arbitrary<std::uint8_t>();
  packet.target = spec::has(flags, spec::V2Flag::HasTarget) ? 0xD8 : 0;
  packet.error = spec::has(flags, spec::V2Flag::Response) ? 3 : 0;
  packet.data = data;
  const auto items = decode(encode(packet));
  RC_ASSERT(items.size() == 1u);
  RC_ASSERT(items[0].packet == packet);
}

} // namespace
} // namespace orb::protocol
