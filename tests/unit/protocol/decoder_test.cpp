#include "protocol/decoder.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

using Kind = Item::Kind;

/// An item found by a decoder, with bytes of its own.
struct Found {
  Kind kind;
  std::uint8_t did_or_code;
  Bytes data;
  Bytes raw;
};

void drain(Decoder& decoder, std::vector<Found>& found) {
  while (const auto item = decoder.next())
    found.push_back({item->kind,
                     item->kind == Kind::Command ? item->did : item->code,
                     {item->data.begin(), item->data.end()},
                     {item->raw.begin(), item->raw.end()}});
}

std::vector<Found> decode(Direction direction, std::initializer_list<Bytes> pieces) {
  Decoder decoder(direction);
  std::vector<Found> found;
  for (const auto& piece : pieces) {
    decoder.feed(piece);
    drain(decoder, found);
  }
  decoder.expire();
  drain(decoder, found);
  return found;
}

std::vector<Kind> kinds(const std::vector<Found>& found) {
  std::vector<Kind> out;
  for (const auto& item : found)
    out.push_back(item.kind);
  return out;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

const Bytes ping_bytes = {0xFF, 0xFF, 0x00, 0x01, 0x52, 0x01, 0xAB};

TEST(Packet, PingIsTheExampleOfTheDocument) {
  EXPECT_EQ(encode(make_command(spec::ApiCommand::Ping, {}, 0x52)), ping_bytes);
}

TEST(Packet, AnswersAndMessagesHaveTheDocumentedLayout) {
  EXPECT_EQ(encode(Response{0, 0x52, {}}), (Bytes{0xFF, 0xFF, 0x00, 0x52, 0x01, 0xAC}));
  EXPECT_EQ(encode(Async{1, {2}}), (Bytes{0xFF, 0xFE, 0x01, 0x00, 0x02, 0x02, 0xFA}));
}

TEST(Packet, LongPayloadsGoOutUnderDlenFF) {
  const auto ssb = encode(make_command(spec::ApiCommand::SetSsb, Bytes(1028, 7)));
  EXPECT_EQ(ssb.size(), 6u + 1028 + 1);
  EXPECT_EQ(ssb[5], 0xFF);
  const auto found = decode(Direction::ToBall, {ssb});
  ASSERT_EQ(kinds(found), std::vector{Kind::Command});
  EXPECT_EQ(found[0].data, Bytes(1028, 7));
}

TEST(Packet, DlenFFIsAnOrdinaryLengthElsewhere) {
  const auto append = make_command(spec::ApiCommand::AppendOrbbasicFragment, Bytes(254, 1));
  EXPECT_EQ(encode(append).size(), 6u + 255);
  const auto found = decode(Direction::ToBall, {encode(append) + ping_bytes});
  ASSERT_EQ(kinds(found), (std::vector{Kind::Command, Kind::Command}));
  EXPECT_EQ(found[0].data.size(), 254u);
}

RC_GTEST_PROP(Packet, ChecksumIsTheInvertedSum, (const Bytes& bytes)) {
  unsigned sum = 0;
  for (const auto byte : bytes)
    sum += byte;
  RC_ASSERT(checksum(bytes) == static_cast<std::uint8_t>(~sum));
}

TEST(Packet, ChecksumOfManyLargeBytesDoesNotOverflow) {
  EXPECT_EQ(checksum(Bytes(70001, 0xFF)), static_cast<std::uint8_t>(~(70001u * 0xFF)));
}

TEST(Decoder, SkipsNoiseAndReportsItOnce) {
  const auto found = decode(Direction::ToBall, {Bytes{0x0D, 0x75, 0xFF, 0x3E} + ping_bytes});
  ASSERT_EQ(kinds(found), (std::vector{Kind::Noise, Kind::Command}));
  EXPECT_EQ(found[0].raw, (Bytes{0x0D, 0x75, 0xFF, 0x3E}));
  EXPECT_EQ(found[1].raw, ping_bytes);
}

TEST(Decoder, AStrayFFBeforeAPacketCostsOnlyItself) {
  // FF FF FF 00 … first looks like device FFh, which would wait for 81 more bytes.
  Decoder decoder(Direction::ToBall);
  const auto bytes = Bytes{0xFF} + ping_bytes;
  decoder.feed(bytes);
  std::vector<Found> found;
  drain(decoder, found);
  ASSERT_EQ(kinds(found), (std::vector{Kind::Noise, Kind::Command}));
  EXPECT_EQ(found[1].raw, ping_bytes);
}

TEST(Decoder, RescansFromTheByteAfterSop1OfADamagedPacket) {
  auto damaged = encode(make_command(spec::ApiCommand::SaveTemporaryMacro, ping_bytes));
  damaged.back() ^= 1;
  const auto found = decode(Direction::ToBall, {damaged});
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[0].kind, Kind::BadChecksum);
  EXPECT_EQ(found[0].raw, damaged);
  bool ping_found = false;
  for (const auto& item : found)
    ping_found |= item.kind == Kind::Command && item.raw == ping_bytes;
  EXPECT_TRUE(ping_found);
}

TEST(Decoder, AnExpiredHalfPacketIsOneFragmentAndGivesBackWhatItSwallowed) {
  const auto found =
      decode(Direction::ToBall, {{0xFF, 0xFF, 0x02, 0x61, 0x09, 0x40}, ping_bytes, ping_bytes});
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, Kind::Fragment);
  std::size_t pings = 0, fragments = 0;
  for (const auto& item : found) {
    pings += item.kind == Kind::Command;
    fragments += item.kind == Kind::Fragment;
  }
  EXPECT_EQ(pings, 2u);
  EXPECT_EQ(fragments, 1u);
}

TEST(Decoder, ReadsAnswersAndMessages) {
  const auto found = decode(Direction::FromBall, {encode(Response{8, 3, {1, 2}}) + Bytes{0x0D} +
                                                  encode(Async{0x0D, Bytes(1024, 9)})});
  ASSERT_EQ(kinds(found), (std::vector{Kind::Response, Kind::Noise, Kind::Async}));
  EXPECT_EQ(found[0].did_or_code, 8);
  EXPECT_EQ(found[2].data.size(), 1024u);
}

TEST(Decoder, ADamagedMessageLengthDoesNotSwallowTheStream) {
  auto message = encode(Async{3, {1, 2}});
  message[3] = 0xFF; // 65283 bytes to come
  const auto answer = encode(Response{0, 1, {}});
  Decoder decoder(Direction::FromBall);
  const auto stream = message + answer;
  decoder.feed(stream);
  std::vector<Found> found;
  drain(decoder, found);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.back().kind, Kind::Response);
}

/// Generates mixtures of packets and other bytes, with many start bytes.
rc::Gen<Bytes> stream() {
  const auto byte = rc::gen::oneOf(rc::gen::elementOf(Bytes{0xFF, 0xFF, 0xFE, 0, 1, 2, 0x43, 0x47}),
                                   rc::gen::arbitrary<std::uint8_t>());
  const auto junk = rc::gen::container<Bytes>(byte);
  const auto command = rc::gen::map(junk, [](Bytes data) {
    data.resize(std::min<std::size_t>(data.size(), 254));
    return encode(make_command(spec::ApiCommand::SaveMacro, std::move(data)));
  });
  return rc::gen::map(rc::gen::container<std::vector<Bytes>>(rc::gen::oneOf(junk, command)),
                      [](const std::vector<Bytes>& parts) {
                        Bytes all;
                        for (const auto& part : parts)
                          all.insert(all.end(), part.begin(), part.end());
                        // The result for three FFh in a row depends on what has arrived so far.
                        for (std::size_t i = 2; i < all.size(); ++i)
                          if (all[i] == 0xFF && all[i - 1] == 0xFF && all[i - 2] == 0xFF)
                            all[i] = 0;
                        return all;
                      });
}

TEST(Decoder, AStrayStartByteIsJudgedAlikeHoweverTheBytesArrive) {
  // Read from the first byte this is a packet to device FFh of 53h bytes, read from the second a
  // ping: the ping is complete first.
  auto bytes = Bytes{spec::sop1};
  encode(make_command(spec::ApiCommand::Ping, {}, 0x52), bytes);
  bytes.resize(100, 0);
  for (const std::size_t piece : {std::size_t{1}, bytes.size()}) {
    Decoder decoder(Direction::ToBall);
    std::vector<Found> found;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      decoder.feed(ByteView(bytes).subspan(at, piece));
      drain(decoder, found);
    }
    ASSERT_GE(found.size(), 2U) << piece;
    EXPECT_EQ(found[0].kind, Kind::Noise) << piece;
    EXPECT_EQ(found[1].kind, Kind::Command) << piece;
  }
}

TEST(Decoder, KeepsWhatNobodyAskedForYet) {
  const auto ping = encode(make_command(spec::ApiCommand::Ping, {}));
  Decoder decoder(Direction::ToBall);
  std::vector<Found> found;
  for (int n = 0; n < 2; ++n) {
    auto fed = ping;
    fed.insert(fed.end(), ping.begin(), ping.end());
    decoder.feed(fed);
    std::fill(fed.begin(), fed.end(), std::uint8_t{0}); // the decoder must have copied them
    EXPECT_TRUE(decoder.next());
  }
  drain(decoder, found);
  EXPECT_EQ(found.size(), 2U); // two of the four were left
  for (const auto& item : found)
    EXPECT_EQ(item.kind, Kind::Command);
}

RC_GTEST_PROP(Decoder, FindsTheSameHoweverTheBytesArrive, (bool to_ball)) {
  const auto bytes = *stream();
  const auto direction = to_ball ? Direction::ToBall : Direction::FromBall;
  Decoder whole(direction);
  std::vector<Found> expected;
  whole.feed(bytes);
  drain(whole, expected);

  Decoder pieces(direction);
  std::vector<Found> found;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto size = std::min(*rc::gen::inRange<std::size_t>(1, 40), bytes.size() - at);
    const Bytes piece(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
    pieces.feed(piece);
    drain(pieces, found);
    at += size;
  }
  // Noise may be divided differently; packets may not.
  const auto is_noise = [](const Found& item) { return item.kind == Kind::Noise; };
  std::erase_if(expected, is_noise);
  std::erase_if(found, is_noise);
  RC_ASSERT(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    RC_ASSERT(found[i].raw == expected[i].raw);
}

} // namespace
} // namespace orb::protocol
