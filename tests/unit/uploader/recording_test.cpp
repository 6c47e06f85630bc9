#include "protocol/recording.h"

#include "tests/unit/uploader/model_ball.h"

#include <gtest/gtest.h>

namespace orb::uploader {
namespace {

using protocol::parse_recording;
using protocol::RecordingTransport;
using protocol::ReplayTransport;

class Recorder final : public protocol::WireListener {
public:
  void on_bytes(protocol::Direction direction, ByteView bytes, Instant) override {
    text += protocol::recording_line(direction, bytes);
  }
  std::string text = "# a recording\n";
};

Report upload_over(protocol::Transport& link, std::uint8_t first_seq) {
  Session session(link, Budgets{}, first_seq);
  const auto greeting = greet(session);
  if (!greeting)
    return greeting.error();
  NullProgress progress;
  return upload(session, ProgramJob{sixty_lines(), Area::Flash, std::uint16_t{10}}, *greeting,
                BatteryPolicy::Refuse, progress);
}

std::string record() {
  Recorder recorder;
  RecordingTransport link(std::make_unique<ModelBall>(), recorder);
  EXPECT_EQ(upload_over(link, 0x77).kind, Report::Kind::Done);
  return recorder.text;
}

TEST(Recording, PlaysBackWhatWasRecorded) {
  const auto pieces = parse_recording(record());
  ASSERT_TRUE(pieces.has_value());
  EXPECT_EQ(protocol::first_recorded_seq(*pieces), 0x77);
  ReplayTransport replay(*pieces);
  EXPECT_EQ(upload_over(replay, 0x77).kind, Report::Kind::Done);
}

TEST(Recording, FailsAtTheFirstOtherByte) {
  const auto pieces = parse_recording(record());
  ReplayTransport replay(*pieces);
  const auto report = upload_over(replay, 0x78);
  EXPECT_NE(report.kind, Report::Kind::Done);
  EXPECT_NE(report.message.find("sent byte 5 is 78h, but the recording has 77h"), std::string::npos)
      << report.message;
}

TEST(Recording, FailsWhereItEndsTooEarly) {
  auto pieces = *parse_recording(record());
  pieces.resize(pieces.size() / 2);
  ReplayTransport replay(pieces);
  EXPECT_EQ(upload_over(replay, 0x77).kind, Report::Kind::LinkLost);
}

TEST(Recording, IsHeardToItsEndByAClientThatOnlyListens) {
  ReplayTransport replay(*parse_recording("  > 01\n< 02\n> 03\n> 04\n< 05\n"));
  Bytes heard;
  for (int reads = 0; reads < 100'000; ++reads) {
    const auto read = replay.read(replay.now() + 100ms);
    if (!read) {
      EXPECT_EQ(read.error().kind, protocol::LinkError::Kind::Ended);
      EXPECT_EQ(heard, (Bytes{2, 5}));
      return;
    }
    heard.insert(heard.end(), read->begin(), read->end());
  }
  FAIL() << "it never ends";
}

TEST(Recording, MayBeginLinesWithATime) {
  const auto pieces = parse_recording("0.000 > FF FF\n12.5\t< 01\n");
  ASSERT_TRUE(pieces) << pieces.error();
  ASSERT_EQ(pieces->size(), 2U);
  EXPECT_EQ((*pieces)[0].direction, protocol::Direction::ToBall);
  EXPECT_EQ(to_hex((*pieces)[1].bytes), "01");
  for (const auto* line : {"12.5", "12.5 FF", "12.5 13.5 > FF"})
    EXPECT_FALSE(parse_recording(line)) << line;
}

TEST(Recording, NamesALineThatIsNone) {
  EXPECT_EQ(parse_recording("> FF\r\n\n# x\n< 0\n").error(),
            "line 4 is not `> FF FF …` (sent) or `< FF FF …` (received)");
  EXPECT_FALSE(parse_recording("FF FF").has_value());
}

} // namespace
} // namespace orb::uploader
