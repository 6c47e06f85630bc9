#include "serve/packet_spacer.h"

#include <gtest/gtest.h>

namespace orb::serve {
namespace {

using namespace std::chrono_literals;

constexpr Instant start{};

TEST(PacketSpacer, KeepsMessagesApartFromEachOtherAndFromAnswers) {
  PacketSpacer spacer;
  spacer.add_message({1}, start);
  spacer.add_message({2}, start);
  EXPECT_EQ(spacer.take(start), std::vector<Bytes>{{1}});
  EXPECT_EQ(spacer.next_due(), start + 2ms);
  spacer.add_answer({3});
  EXPECT_EQ(spacer.take(start + 1ms), std::vector<Bytes>{{3}});
  EXPECT_EQ(spacer.next_due(), start + 9ms);
  EXPECT_TRUE(spacer.take(start + 8ms).empty());
  EXPECT_EQ(spacer.take(start + 9ms), std::vector<Bytes>{{2}});
  EXPECT_EQ(spacer.next_due(), never);
}

TEST(PacketSpacer, HoldsNoMessageForEver) {
  PacketSpacer spacer;
  spacer.add_message({1}, start);
  for (auto now = start; now < start + 20ms; now += 5ms) {
    spacer.add_answer({2});
    EXPECT_EQ(spacer.take(now), std::vector<Bytes>{{2}});
  }
  EXPECT_EQ(spacer.take(start + 20ms), std::vector<Bytes>{{1}});
}

TEST(PacketSpacer, SendsManyAnswersAtOnceAndHurriesInOrder) {
  PacketSpacer spacer;
  for (std::uint8_t i = 0; i < 17; ++i)
    spacer.add_answer({i});
  EXPECT_EQ(spacer.take(start).size(), 1U);
  spacer.add_answer({1});
  spacer.add_message({2}, start);
  spacer.hurry();
  spacer.add_answer({3});
  EXPECT_EQ(spacer.take(start), (std::vector<Bytes>{{1}, {2}, {3}}));
}

} // namespace
} // namespace orb::serve
