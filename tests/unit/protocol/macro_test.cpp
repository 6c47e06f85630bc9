#include "protocol/macro.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

using spec::MacroCommand;

struct Row {
  MacroCommand command;
  std::vector<std::int32_t> values;
  std::string hex;
};

/// Bytes written by the vendor's macro classes, and by the quick reference for codes missing there.
const Row rows[] = {
    {MacroCommand::End, {}, "00"},
    {MacroCommand::SetSd1, {0x1234}, "01 12 34"},
    {MacroCommand::SetSd2, {0x1234}, "02 12 34"},
    {MacroCommand::Stabilization, {1, 0x77}, "03 01 77"},
    {MacroCommand::SetHeading, {0x123, 0x77}, "04 01 23 77"},
    {MacroCommand::Roll, {0x7F, 0x123, 0x77}, "05 7F 01 23 77"},
    {MacroCommand::RollSd1, {0x7F, 0x123}, "06 7F 01 23"},
    {MacroCommand::Rgb, {0x11, 0x22, 0x33, 0x77}, "07 11 22 33 77"},
    {MacroCommand::RgbSd2, {0x11, 0x22, 0x33}, "08 11 22 33"},
    {MacroCommand::BackLed, {0x44, 0x77}, "09 44 77"},
    {MacroCommand::RawMotors, {1, 0x55, 2, 0x66, 0x77}, "0A 01 55 02 66 77"},
    {MacroCommand::Delay, {0x1234}, "0B 12 34"},
    {MacroCommand::Goto, {0x20}, "0C 20"},
    {MacroCommand::Gosub, {0x20}, "0D 20"},
    {MacroCommand::Sleep, {0x1234}, "0E 12 34"},
    {MacroCommand::SetSpd1, {0xFF}, "0F FF"},
    {MacroCommand::SetSpd2, {0x7F}, "10 7F"},
    {MacroCommand::RollSpd1Sd1, {0x123}, "11 01 23"},
    {MacroCommand::RollSpd2Sd1, {0x123}, "12 01 23"},
    {MacroCommand::RotationRate, {0x80}, "13 80"},
    {MacroCommand::Fade, {0x11, 0x22, 0x33, 0x1234}, "14 11 22 33 12 34"},
    {MacroCommand::Marker, {9}, "15 09"},
    {MacroCommand::WaitUntilStopped, {0x1234}, "19 12 34"},
    {MacroCommand::Rotate, {-720, 5000}, "1A FD 30 13 88"},
    {MacroCommand::StreamEnd, {}, "1B"},
    {MacroCommand::Roll2, {0x7F, 0x123, 0x1234}, "1D 7F 01 23 12 34"},
    {MacroCommand::LoopStart, {5}, "1E 05"},
    {MacroCommand::LoopEnd, {}, "1F"},
    {MacroCommand::Comment, {}, "20 00 05 68 65 6C 6C 6F"},
    {MacroCommand::RotateSd1, {-720}, "21 FD 30"},
    {MacroCommand::RotateSd2, {720}, "22 02 D0"},
    {MacroCommand::OnCollision, {0x20}, "23 20"},
    {MacroCommand::LoopStartSystem, {}, "24"},
    {MacroCommand::SetSpeed, {0, 0x77}, "25 00 77"},
    {MacroCommand::ConfigureCollision, {1, 2, 3, 4, 5, 6}, "27 01 02 03 04 05 06"},
};

TEST(Macro, TheVectorsCoverEveryCommand) {
  ASSERT_EQ(std::size(rows), std::size(spec::macro_commands));
  for (std::size_t i = 0; i < std::size(rows); ++i)
    EXPECT_EQ(rows[i].command, spec::macro_commands[i].command);
}

TEST(Macro, EachCommandIsWrittenAsTheVendorWritesIt) {
  for (const auto& row : rows) {
    Bytes out;
    append_macro_command(out, row.command, row.values, "hello");
    EXPECT_EQ(to_hex(out), row.hex) << spec::info(row.command).mnemonic;
  }
}

TEST(Macro, EachCommandIsReadAsItIsWritten) {
  for (const auto& row : rows) {
    const auto bytes = *from_hex(row.hex);
    const auto step = read_macro_command(bytes, 0);
    ASSERT_TRUE(step) << row.hex;
    EXPECT_EQ(step->info->command, row.command);
    EXPECT_EQ(step->size, bytes.size());
    for (std::size_t i = 0; i < row.values.size(); ++i)
      EXPECT_EQ(step->value[i], row.values[i]) << row.hex;
  }
}

TEST(Macro, APostCommandDelayIsTheLastByteOfExactlyTheseCommands) {
  std::string codes;
  for (const auto& info : spec::macro_commands)
    if (info.has_pcd)
      codes += to_hex(std::array{info.code}) + " ";
  EXPECT_EQ(codes, "03 04 05 07 09 0A 25 ");
}

TEST(Macro, ACommandCutAnywhereSaysWhichOperandIsMissing) {
  for (const auto& row : rows) {
    const auto bytes = *from_hex(row.hex);
    for (std::size_t size = 1; size < bytes.size(); ++size) {
      const auto step = read_macro_command(ByteView(bytes).first(size), 0);
      ASSERT_FALSE(step) << row.hex << " cut to " << size;
      EXPECT_LE(step.error().offset, size);
    }
  }
  const auto cut = read_macro_command(*from_hex("05 7F 01"), 0);
  EXPECT_EQ(to_string(cut.error()),
            "offset 2 (02h): the data ends inside `roll` (05h); expected its operand `heading`, "
            "found 3 of the 5 bytes that the command takes");
}

TEST(Macro, UnassignedCodesAreNoCommands) {
  for (const int code : {0x16, 0x17, 0x18, 0x1C, 0x26, 0x28, 0x61, 0xFF}) {
    const std::uint8_t bytes[] = {static_cast<std::uint8_t>(code), 0, 0, 0, 0};
    const auto step = read_macro_command(bytes, 0);
    ASSERT_FALSE(step);
    EXPECT_EQ(step.error().kind, MacroError::Kind::UnknownCode);
  }
}

TEST(Macro, ABodyEndsAtItsEnd) {
  const auto whole = decode_macro_body(*from_hex("15 AA 15 BB 00"));
  EXPECT_FALSE(whole.error);
  EXPECT_TRUE(whole.has_end);
  EXPECT_EQ(whole.steps.size(), 3U);
  const auto open = decode_macro_body(*from_hex("15 AA"));
  EXPECT_FALSE(open.error);
  EXPECT_FALSE(open.has_end);
  const auto more = decode_macro_body(*from_hex("15 AA 00 15 BB 00"));
  ASSERT_TRUE(more.error);
  EXPECT_EQ(to_string(*more.error),
            "offset 3 (03h): 3 bytes after `end`; expected the macro to end here");
}

TEST(Macro, ACommentLongerThanTheMacroIsCut) {
  const auto step = read_macro_command(*from_hex("20 FF FF 68"), 0);
  ASSERT_FALSE(step);
  EXPECT_EQ(step.error().kind, MacroError::Kind::CutText);
  EXPECT_EQ(step.error().wanted, 65535U);
  EXPECT_EQ(step.error().present, 1U);
}

TEST(Macro, TheHeaderHasAThirdByteWhenTheFlagsSaySo) {
  const auto plain = decode_macro(*from_hex("40 14 15 AA 15 BB 00"));
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->id, 0x40);
  EXPECT_EQ(to_hex(plain->body), "15 AA 15 BB 00");
  const auto extended = decode_macro(*from_hex("40 94 07 00"));
  ASSERT_TRUE(extended);
  EXPECT_EQ(extended->extended_flags, 7);
  EXPECT_EQ(to_hex(encode(*extended)), "40 94 07 00");
  EXPECT_FALSE(decode_macro(*from_hex("40 94")));
  EXPECT_FALSE(decode_macro(*from_hex("40")));
  EXPECT_FALSE(decode_macro({}));
}

RC_GTEST_PROP(Macro, AnyBytesDecodeToStepsThatCoverThem, (const Bytes& bytes)) {
  const auto listing = decode_macro_body(bytes);
  std::uint32_t at = 0;
  for (const auto& step : listing.steps) {
    RC_ASSERT(step.offset == at);
    at += step.size;
  }
  RC_ASSERT(at <= bytes.size());
  RC_ASSERT(listing.error.has_value() || at == bytes.size());
}

} // namespace
} // namespace orb::protocol
