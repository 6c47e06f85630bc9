#include "protocol/capture/capture.h"

#include "protocol/packet_v2.h"
#include "protocol/payload_v2.h"
#include "tests/fakes/capture_writer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

using Format = CaptureWriter::Format;
constexpr Format formats[] = {Format::Btsnoop,      Format::BtsnoopH1, Format::BtsnoopMonitor,
                              Format::Pcap,         Format::PcapH4,    Format::Pcapng,
                              Format::PcapngMonitor};

constexpr const char* anti_dos = "00020005-574f-4f20-5370-6865726f2121";
constexpr const char* packets_v2 = "00010002-574f-4f20-5370-6865726f2121";
constexpr const char* battery_level = "00002a19-0000-1000-8000-00805f9b34fb";

const Bytes wake_v2 = *from_hex("8D 0A 13 0D 00 D5 D8");
const Bytes woken_v2 = *from_hex("8D 09 13 0D 00 00 D6 D8");
const Bytes ping_v1 = *from_hex("FF FF 00 01 52 01 AB");
const Bytes pong_v1 = *from_hex("FF FF 00 52 01 AC");

/// A client finds, opens and wakes a BOLT, and queries the battery of a watch nearby.
Bytes bolt_session(Format format) {
  CaptureWriter writer(format);
  writer.advertise(1, "SB-0001");
  writer.at_ms(500);
  writer.connect(0x40, 1);
  writer.discover(0x40, 0x10, anti_dos);
  writer.discover(0x40, 0x20, packets_v2);
  writer.discover(0x40, 0x30, battery_level);
  writer.at_ms(1000);
  writer.write(0x40, 0x10, as_bytes("usetheforce...band"));
  writer.write(0x40, 0x30, wake_v2); // not the handle of packets
  writer.at_ms(1250);
  writer.write(0x40, 0x20, ByteView(wake_v2).first(3));
  writer.write(0x40, 0x20, ByteView(wake_v2).subspan(3));
  writer.at_ms(1300);
  writer.notify(0x40, 0x20, woken_v2);
  writer.at_ms(2000);
  writer.disconnect(0x40);
  return writer.file();
}

std::string told_lines(const Conversation& conversation) {
  std::string out;
  for (const auto& line : conversation.lines)
    out += line.when +
           (line.greets                           ? " # "
            : line.direction == Direction::ToBall ? " > "
                                                  : " < ") +
           to_hex(line.bytes) + "\n";
  return out;
}

TEST(Capture, EveryFormatTellsTheSame) {
  for (const auto format : formats) {
    const auto capture = read_capture(bolt_session(format));
    ASSERT_TRUE(capture);
    EXPECT_FALSE(capture->frames.cut) << capture->frames.format;
    ASSERT_EQ(capture->conversations.size(), 1U) << capture->frames.format;
    const auto& conversation = capture->conversations[0];
    EXPECT_EQ(told_lines(conversation),
              "1.000 # 75 73 65 74 68 65 66 6F 72 63 65 2E 2E 2E 62 61 6E 64\n"
              "1.250 > 8D 0A 13\n"
              "1.250 > 0D 00 D5 D8\n"
              "1.300 < 8D 09 13 0D 00 00 D6 D8\n")
        << capture->frames.format;
    EXPECT_EQ(conversation.robot, "C4:E7:00:11:22:01");
    EXPECT_EQ(conversation.kind, spec::Robot::Bolt);
    EXPECT_TRUE(conversation.has_start && conversation.has_end && conversation.has_lock);
  }
}

TEST(Capture, GuessesHandlesWhereItBeganLater) {
  CaptureWriter writer(Format::Btsnoop);
  writer.write(0x40, 0x09, as_bytes("hello"));
  writer.write(0x40, 0x10, as_bytes("usetheforce...band"));
  writer.write(0x40, 0x20, wake_v2);
  writer.notify(0x40, 0x20, woken_v2);
  const auto capture = read_capture(writer.file());
  ASSERT_EQ(capture->conversations.size(), 1U);
  const auto& conversation = capture->conversations[0];
  ASSERT_EQ(conversation.lines.size(), 3U);
  EXPECT_TRUE(conversation.lines[0].greets);
  EXPECT_EQ(conversation.lines[1].bytes, wake_v2);
  EXPECT_EQ(conversation.robot, "");
  EXPECT_FALSE(conversation.has_start || conversation.has_end);
}

TEST(Capture, KnowsARobotThatWasDiscoveredBefore) {
  CaptureWriter writer(Format::Pcapng);
  writer.connect(0x40, 1);
  writer.discover(0x40, 0x10, "22bb746f-2bbf-7554-2d6f-726568705327");
  writer.disconnect(0x40);
  writer.connect(0x41, 1);
  writer.write(0x41, 0x10, Bytes{1}); // nobody could guess its meaning
  const auto capture = read_capture(writer.file());
  ASSERT_EQ(capture->conversations.size(), 1U);
  EXPECT_TRUE(capture->conversations[0].lines[0].greets);
}

TEST(Capture, KeepsRobotsAndConnectionsApart) {
  CaptureWriter writer(Format::Pcap);
  writer.connect(0x40, 1);
  writer.connect(0x41, 2);
  writer.write(0x41, 0x20, wake_v2);
  writer.write(0x40, 0x0E, ping_v1);
  writer.disconnect(0x40);
  writer.connect(0x40, 1);
  writer.write(0x40, 0x0E, ping_v1);
  const auto capture = read_capture(writer.file());
  ASSERT_EQ(capture->conversations.size(), 3U);
  EXPECT_EQ(capture->conversations[0].robot, "C4:E7:00:11:22:02");
  EXPECT_EQ(capture->conversations[1].robot, "C4:E7:00:11:22:01");
  EXPECT_TRUE(capture->conversations[1].has_end);
  EXPECT_FALSE(capture->conversations[2].has_end);
}

TEST(Capture, ReadsTheSerialPortOfClassicBluetooth) {
  for (const auto format : formats) {
    if (format == Format::PcapH4)
      continue; // this format has no directions
    CaptureWriter writer(format);
    writer.connect_classic(0x0B, 7);
    writer.send_serial(0x0B, ping_v1);
    writer.hear_serial(0x0B, pong_v1);
    Bytes longer;
    for (int i = 0; i < 30; ++i)
      longer.insert(longer.end(), ping_v1.begin(), ping_v1.end());
    writer.send_serial(0x0B, longer);
    const auto capture = read_capture(writer.file());
    ASSERT_EQ(capture->conversations.size(), 1U) << capture->frames.format;
    const auto& conversation = capture->conversations[0];
    EXPECT_EQ(conversation.carrier, Carrier::Rfcomm);
    ASSERT_EQ(conversation.lines.size(), 3U);
    EXPECT_EQ(conversation.lines[0].bytes, ping_v1);
    EXPECT_EQ(conversation.lines[1].direction, Direction::FromBall);
    EXPECT_EQ(conversation.lines[2].bytes, longer);
  }
}

TEST(Capture, HasNoRobotWhereOthersSpeak) {
  CaptureWriter writer(Format::Btsnoop);
  writer.connect(0x40, 1);
  writer.discover(0x40, 0x30, battery_level);
  writer.write(0x40, 0x30, as_bytes("hello"));
  const auto capture = read_capture(writer.file());
  ASSERT_TRUE(capture);
  EXPECT_TRUE(capture->conversations.empty());
  EXPECT_GT(capture->frames.count, 2U);
}

TEST(Capture, OtherFilesAreNone) {
  for (const auto* text : {"", "b", "btsnoop", "> FF FF 00 01 52 01 AB\n"})
    EXPECT_FALSE(read_capture(as_bytes(text))) << text;
}

// A truncated file says so, and its content is the beginning of the whole one's.
TEST(Capture, ReadsTheBeginningOfWhatWasCut) {
  for (const auto format : formats) {
    const auto file = bolt_session(format);
    const auto whole = read_capture(file);
    const auto all = told_lines(whole->conversations[0]);
    std::size_t whole_frames = 0;
    for (std::size_t size = 8; size < file.size(); ++size) {
      const auto capture = read_capture(ByteView(file).first(size));
      ASSERT_TRUE(capture) << size;
      whole_frames += capture->frames.cut ? 0 : 1;
      if (!capture->conversations.empty()) {
        EXPECT_TRUE(all.starts_with(told_lines(capture->conversations[0]))) << size;
      }
    }
    EXPECT_LE(whole_frames, whole->frames.count + 2) << whole->frames.format;
  }
}

RC_GTEST_PROP(Capture, ReadsAnyBytes, (const Bytes& noise, std::uint8_t which, Bytes end)) {
  auto file = bolt_session(formats[which % std::size(formats)]);
  for (std::size_t i = 0; i + 1 < noise.size(); i += 2)
    file[noise[i] * std::size_t{7} % file.size()] = noise[i + 1];
  file.insert(file.end(), end.begin(), end.end());
  if (const auto capture = read_capture(file))
    for (const auto& conversation : capture->conversations)
      RC_ASSERT(!conversation.lines.empty());
}

} // namespace
} // namespace orb::protocol
