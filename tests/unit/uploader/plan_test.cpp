#include "uploader/plan.h"

#include "tests/unit/uploader/model_ball.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::uploader {
namespace {

/// Whether a ball takes a packet of these bytes for a whole one.
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
  for (unsigned seq = 0; seq < 256; ++seq) {
    const auto plan = make_plan(ProgramJob{sixty_lines(), Area::Ram, {}}, default_firmware(),
                                Budgets{}, static_cast<std::uint8_t>(seq));
    ASSERT_TRUE(plan.has_value());
    std::string text;
    for (const auto& step : plan->steps) {
      auto packet = encode(step.command);
      if (step.kind == StepKind::Append)
        text.append(step.command.data.begin() + 1, step.command.data.end());
      for (unsigned bit = 0; bit < 8; ++bit) {
        auto damaged = packet;
        damaged[dlen_at] = static_cast<std::uint8_t>(damaged[dlen_at] ^ 1U << bit);
        EXPECT_FALSE(is_taken(damaged)) << to_hex(packet);
      }
    }
    EXPECT_EQ(text, as_string(sixty_lines()));
    shortened += plan->steps[5].command.data.size() < spec::max_payload ? 1 : 0;
  }
  EXPECT_GT(shortened, 0U) << "no sequence number needs a shorter fragment, so nothing was tested";
}

TEST(Plan, KnowsWhatAFirmwareHas) {
  const auto newest = read_firmware(Bytes{2, 2, 3, 3, 0x33, 0x21, 0x16, 4, 1, 50});
  EXPECT_EQ(newest.ram_bytes, 4096U);
  EXPECT_TRUE(newest.can_commit);
  const auto april = read_firmware(Bytes{2, 2, 3, 1, 0x2E, 0x20, 0x15, 4, 1, 46});
  EXPECT_EQ(april.ram_bytes, 3072U);
  EXPECT_FALSE(april.can_commit);
  const auto oldest = read_firmware(Bytes{1, 2, 2, 0, 0x62, 0x17, 0x09, 2});
  EXPECT_EQ(oldest.ram_bytes, 1024U);
  EXPECT_FALSE(oldest.can_commit);
  EXPECT_TRUE(oldest.has_basic);
  EXPECT_FALSE(read_firmware(Bytes{1, 0x1E, 1, 4, 0x3F, 0x48, 0, 6}).has_basic);
}

TEST(Plan, ChoosesTheSafeWayIntoFlash) {
  const ProgramJob job{sixty_lines(), Area::Flash, {}};
  auto firmware = default_firmware();
  EXPECT_EQ(choose_route(job, firmware), Route::RamThenFlash);
  firmware.ram_bytes = 1024;
  EXPECT_EQ(choose_route(job, firmware), Route::FlashDirectly);
  const auto plan = make_plan(job, firmware, Budgets{}, 0);
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
  const auto pieces = stream_pieces(image);
  ASSERT_TRUE(pieces.has_value());
  Bytes body;
  for (const auto& piece : *pieces) {
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
