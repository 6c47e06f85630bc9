#include "protocol/link_faults.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

constexpr Instant start{1s};

FaultPlan plan_of(std::string_view text) {
  const auto plan = parse_fault_plan(text);
  EXPECT_TRUE(plan.has_value()) << text;
  return plan.value_or(FaultPlan{});
}

/// Takes everything that arrives within a minute in one direction.
Bytes take_all(FaultPipe& pipe, Direction direction, Instant now = start) {
  Bytes out;
  while (true) {
    const auto piece = pipe.take(direction, now);
    out.insert(out.end(), piece.begin(), piece.end());
    if (!piece.empty())
      continue;
    if (now > start + 60s || pipe.cut())
      return out;
    now += 1ms;
  }
}

Bytes ping(std::uint8_t seq) {
  return encode(make_command(spec::ApiCommand::Ping, {}, seq));
}

Bytes ok(std::uint8_t seq) {
  return encode(Response{0, seq, {}});
}

TEST(FaultPlan, ReadsWhatTheCommandLineDocuments) {
  const auto plan = plan_of("drop=1%,flip=0.1%,dup=1%,delay=50..300ms,split,cut@1234,seed=7");
  EXPECT_DOUBLE_EQ(plan.drop, 0.01);
  EXPECT_DOUBLE_EQ(plan.flip, 0.001);
  EXPECT_DOUBLE_EQ(plan.dup, 0.01);
  EXPECT_EQ(plan.delay_least, 50ms);
  EXPECT_EQ(plan.delay_most, 300ms);
  EXPECT_TRUE(plan.split);
  EXPECT_EQ(plan.cut, 1234U);
  EXPECT_EQ(plan.seed, 7U);
}

TEST(FaultPlan, PrintsWhatItReads) {
  for (const auto* text :
       {"none", "drop=1%,flip=0.1%,dup=1%,delay=50..300ms,split,cut@1234,seed=7",
        "dup-request=2%,storm=5%,merge,stale=3,cut-answer@9,flip@1,flip-answer@0,seed=1"})
    EXPECT_EQ(to_string(plan_of(text)), text);
}

TEST(FaultPlan, NamesTheWrongWord) {
  for (const auto* text : {"", "drop=1", "drop=101%", "dropp=1%", "delay=9..1ms", "delay=x", "cut@",
                           "cut@-1", "seed=", "split=1", "drop=1%,", "delay=99999999999999s"})
    EXPECT_FALSE(parse_fault_plan(text).has_value()) << text;
  EXPECT_NE(parse_fault_plan("dropp=1%").error().find("did you mean `drop=`"), std::string::npos);
}

RC_GTEST_PROP(FaultPipe, ChangesNothingWithoutAPlan, (const Bytes& bytes)) {
  for (const auto* plan : {"none", "split", "merge", "delay=1..50ms", "split,merge,delay=5ms"}) {
    FaultPipe pipe(plan_of(plan));
    pipe.push(Direction::FromBall, bytes, start);
    RC_ASSERT(take_all(pipe, Direction::FromBall) == bytes);
  }
}

TEST(FaultPipe, DropsWholePacketsAtTheRate) {
  FaultPipe pipe(plan_of("drop=10%,seed=3"));
  for (int i = 0; i < 1000; ++i)
    pipe.push(Direction::ToBall, ping(static_cast<std::uint8_t>(i)), start);
  const auto out = take_all(pipe, Direction::ToBall);
  EXPECT_EQ(out.size() % ping(0).size(), 0U);
  EXPECT_NEAR(static_cast<double>(out.size() / ping(0).size()), 900, 40);
}

TEST(FaultPipe, FlipsOneBitOfAPacket) {
  FaultPipe pipe(plan_of("flip=100%"));
  pipe.push(Direction::ToBall, ping(0x52), start);
  const auto out = take_all(pipe, Direction::ToBall);
  ASSERT_EQ(out.size(), ping(0x52).size());
  int bits = 0;
  for (std::size_t i = 0; i < out.size(); ++i)
    bits += __builtin_popcount(out[i] ^ ping(0x52)[i]);
  EXPECT_EQ(bits, 1);
}

TEST(FaultPipe, FlipsTheBitThatIsNamed) {
  FaultPipe pipe(plan_of("flip@17"));
  pipe.push(Direction::ToBall, ping(1), start);
  pipe.push(Direction::ToBall, ping(2), start);
  auto expected = ping(1);
  expected[2] ^= 2;
  const auto second = ping(2);
  expected.insert(expected.end(), second.begin(), second.end());
  EXPECT_EQ(take_all(pipe, Direction::ToBall), expected);
}

TEST(FaultPipe, DupDoublesAnswersAndDupRequestCommands) {
  FaultPipe answers(plan_of("dup=100%"));
  answers.push(Direction::ToBall, ping(1), start);
  answers.push(Direction::FromBall, ok(1), start);
  EXPECT_EQ(take_all(answers, Direction::ToBall).size(), ping(1).size());
  EXPECT_EQ(take_all(answers, Direction::FromBall).size(), 2 * ok(1).size());
  FaultPipe requests(plan_of("dup-request=100%"));
  requests.push(Direction::ToBall, ping(1), start);
  requests.push(Direction::FromBall, ok(1), start);
  EXPECT_EQ(take_all(requests, Direction::ToBall).size(), 2 * ping(1).size());
  EXPECT_EQ(take_all(requests, Direction::FromBall).size(), ok(1).size());
}

TEST(FaultPipe, DelaysWithoutOvertaking) {
  FaultPipe pipe(plan_of("delay=50..300ms"));
  Bytes sent;
  for (std::uint8_t i = 0; i < 50; ++i) {
    const auto packet = ping(i);
    sent.insert(sent.end(), packet.begin(), packet.end());
    pipe.push(Direction::ToBall, packet, start + i * 1ms);
  }
  EXPECT_TRUE(pipe.take(Direction::ToBall, start + 49ms).empty());
  EXPECT_EQ(take_all(pipe, Direction::ToBall), sent);
}

TEST(FaultPipe, CutsAfterTheByteThatIsNamedAndOnlyOnce) {
  for (std::uint64_t place = 0; place < 20; ++place) {
    FaultPipe pipe(plan_of(fmt::format("cut@{}", place)));
    for (std::uint8_t i = 0; i < 3; ++i)
      pipe.push(Direction::ToBall, ping(i), start);
    EXPECT_EQ(take_all(pipe, Direction::ToBall).size(), place);
    EXPECT_TRUE(pipe.cut());
    pipe.reconnect(start);
    for (std::uint8_t i = 0; i < 9; ++i)
      pipe.push(Direction::ToBall, ping(i), start);
    EXPECT_EQ(take_all(pipe, Direction::ToBall).size(), 9 * ping(0).size());
  }
}

TEST(FaultPipe, PassesHalfAPacketOnAfterAWhile) {
  FaultPipe pipe(plan_of("none"));
  auto half = ping(1);
  half.resize(3);
  pipe.push(Direction::ToBall, half, start);
  EXPECT_TRUE(pipe.take(Direction::ToBall, start).empty());
  EXPECT_NE(pipe.next_due(), never);
  EXPECT_EQ(take_all(pipe, Direction::ToBall), half);
}

TEST(FaultPipe, StormsAreWholeAsyncMessagesBeforeTheAnswer) {
  FaultPipe pipe(plan_of("storm=100%,seed=5"));
  pipe.push(Direction::FromBall, ok(9), start);
  const auto out = take_all(pipe, Direction::FromBall);
  Decoder decoder(Direction::FromBall);
  decoder.feed(out);
  int messages = 0;
  auto item = decoder.next();
  for (; item && item->kind == Item::Kind::Async; item = decoder.next())
    ++messages;
  EXPECT_GT(messages, 0);
  ASSERT_TRUE(item.has_value());
  EXPECT_EQ(item->kind, Item::Kind::Response);
  EXPECT_EQ(item->seq, 9);
}

TEST(FaultPipe, IsTheSameForTheSameSeed) {
  const auto run = [](std::string_view text) {
    FaultPipe pipe(plan_of(text));
    for (std::uint8_t i = 0; i < 100; ++i)
      pipe.push(Direction::ToBall, ping(i), start);
    return take_all(pipe, Direction::ToBall);
  };
  EXPECT_EQ(run("drop=20%,flip=20%,seed=1"), run("drop=20%,flip=20%,seed=1"));
  EXPECT_NE(run("drop=20%,flip=20%,seed=1"), run("drop=20%,flip=20%,seed=2"));
}

} // namespace
} // namespace orb::protocol
