#include "uploader/plan.h"

#include "tests/unit/uploader/model_ball.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::uploader {
namespace {

/// Returns true if a ball accepts these bytes as a whole packet.
bool is_taken(ByteView bytes) {
  protocol::Decoder decoder(protocol::Direction::ToBall);
  decoder.feed(bytes);
  while (const auto item = decoder.next())
    if (item->kind == protocol::Item::Kind::Command)
      return true;
  return false;
}

TEST(Plan, SendsNoPacketThatOneBitOfDlenMakesAnother) {
  constexpr std::size_t dlen_at = 5;
  std::size_t shortened = 0;
  const auto plan =
      make_plan(ProgramJob{sixty_lines(), Area::Ram, {}}, default_capabilities(), Budgets{});
  ASSERT_TRUE(plan.has_value());
  for (unsigned seq = 0; seq < 256; ++seq) {
    std::string text;
    std::vector<Bytes> fragments;
    for (const auto& command : packets(*plan, static_cast<std::uint8_t>(seq))) {
      auto packet = encode(command);
      if (spec::api_command(command.did, command.cid) == spec::ApiCommand::AppendOrbbasicFragment) {
        text.append(command.data.begin() + 1, command.data.end());
        fragments.push_back(command.data);
      }
      for (unsigned bit = 0; bit < 8; ++bit) {
        auto damaged = packet;
        damaged[dlen_at] = static_cast<std::uint8_t>(damaged[dlen_at] ^ 1U << bit);
        EXPECT_FALSE(is_taken(damaged)) << to_hex(packet);
      }
    }
    EXPECT_EQ(text, as_string(sixty_lines()));
    shortened += fragments.front().size() < spec::max_payload ? 1 : 0;
  }
  EXPECT_GT(shortened, 0U) << "no sequence number needs a shorter fragment, so nothing was tested";
}

TEST(Plan, KnowsWhatAFirmwareHas) {
  const auto newest = read_capabilities(Bytes{2, 2, 3, 3, 0x33, 0x21, 0x16, 4, 1, 50});
  EXPECT_EQ(newest.ram_bytes, 4096U);
  EXPECT_TRUE(newest.can_commit);
  const auto april = read_capabilities(Bytes{2, 2, 3, 1, 0x2E, 0x20, 0x15, 4, 1, 46});
  EXPECT_EQ(april.ram_bytes, 3072U);
  EXPECT_FALSE(april.can_commit);
  const auto oldest = read_capabilities(Bytes{1, 2, 2, 0, 0x62, 0x17, 0x09, 2});
  EXPECT_EQ(oldest.ram_bytes, 1024U);
  EXPECT_FALSE(oldest.can_commit);
  EXPECT_TRUE(oldest.has_basic);
  EXPECT_FALSE(read_capabilities(Bytes{1, 0x1E, 1, 4, 0x3F, 0x48, 0, 6}).has_basic);
  EXPECT_EQ(oldest.macro_executive, 2);
}

TEST(Plan, KnowsWhichOrbBasicABallSpeaks) {
  const auto language = [](std::uint8_t orbbasic, std::uint8_t api_minor) {
    return read_capabilities(Bytes{2, 2, 3, 3, 0x33, 0x21, orbbasic, 4, 1, api_minor}).language;
  };
  using enum spec::BasicVersion;
  EXPECT_EQ(language(0x08, 10), V0_9) << "older than what is known";
  EXPECT_EQ(language(0x14, 31), V1_3) << "a version of which nothing is known is the one before";
  EXPECT_EQ(language(0x16, 46), V1_6);
  EXPECT_EQ(language(0x16, 47), V1_7) << "its API is of May 2013";
  EXPECT_EQ(language(0x19, 50), V1_9);
  EXPECT_EQ(language(0x20, 50), V1_9) << "newer than what is known";
}

TEST(Plan, ChoosesTheSafeWayIntoFlash) {
  const ProgramJob job{sixty_lines(), Area::Flash, {}};
  auto ball = default_capabilities();
  EXPECT_EQ(choose_route(job, ball), Route::RamThenFlash);
  ball.ram_bytes = 1024;
  EXPECT_EQ(choose_route(job, ball), Route::FlashDirectly);
  const auto plan = make_plan(job, ball, Budgets{});
  ASSERT_TRUE(plan.has_value());
  EXPECT_NE(plan->note.find("loses the program"), std::string::npos) << plan->note;
}

TEST(Plan, StreamsWholeCommandsAndEndsTheStream) {
  protocol::MacroImage image;
  image.id = spec::macro_id_stream;
  image.flags = 1;
  for (int i = 0; i < 200; ++i)
    protocol::append_macro_command(image.body, spec::MacroCommand::Delay,
                                   std::array<std::int32_t, 1>{i});
  const auto plan = make_plan(MacroJob{image, MacroKind::Stream}, Budgets{});
  ASSERT_TRUE(plan.has_value());
  Bytes body;
  for (const auto& command : packets(*plan, 0)) {
    if (spec::api_command(command.did, command.cid) != spec::ApiCommand::SaveMacro)
      continue;
    const auto& piece = command.data;
    ASSERT_LE(piece.size(), 250U);
    EXPECT_EQ(piece[0], spec::macro_id_stream);
    EXPECT_FALSE(protocol::decode_macro_body(ByteView(piece).subspan(2)).error.has_value());
    body.insert(body.end(), piece.begin() + 2, piece.end());
  }
  image.body.push_back(static_cast<std::uint8_t>(spec::MacroCommand::StreamEnd));
  EXPECT_EQ(body, image.body);
}

} // namespace
} // namespace orb::uploader
