#include "protocol/payload.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace orb::protocol {
namespace {

using spec::ApiCommand;
using spec::ResponseCode;

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> out;
  bool quoted = false;
  bool fresh = true;
  for (const auto c : text) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ' ' && !quoted) {
      fresh = true;
      continue;
    }
    if (fresh)
      out.emplace_back();
    fresh = false;
    if (c != '"')
      out.back() += c;
  }
  return out;
}

TEST(Payload, EveryExampleEncodesAndReadsBack) {
  for (const auto& row : spec::api_commands) {
    if (spec::long_payload(spec::did(row.command), spec::cid(row.command)) != 0)
      continue; // nobody types a block of 256 bytes
    const auto payload = encode_operands(row.command, words(row.example));
    ASSERT_TRUE(payload) << row.name << ": " << payload.error().message;
    EXPECT_TRUE(Operands::read(row.command, *payload)) << row.name;
  }
}

TEST(Payload, ReadsWhatItWrote) {
  const auto payload = encode_operands(ApiCommand::ConfigureLocator, words("1 -300 0x10 -90"));
  ASSERT_TRUE(payload);
  EXPECT_EQ(*payload, (Bytes{0x01, 0xFE, 0xD4, 0x00, 0x10, 0xFF, 0xA6}));
  const auto operands = Operands::read(ApiCommand::ConfigureLocator, *payload);
  ASSERT_TRUE(operands);
  EXPECT_EQ(operands->number(1), -300);
  EXPECT_EQ(operands->number(3), -90);
}

TEST(Payload, EveryMessageIsReadAsItWasWritten) {
  const Bytes rest = {0x61, 0x62};
  for (const auto& row : spec::asyncs) {
    const auto fields = spec::fields(row.id);
    std::vector<FieldContent> values;
    for (const auto& field : fields)
      values.push_back(spec::is_number(field.type) ? FieldContent(100 + values.size())
                                                   : FieldContent(rest));
    const auto payload = write_fields(fields, values);
    const auto read = read_fields(fields, payload);
    ASSERT_EQ(read.size(), fields.size()) << row.name;
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].number, values[i].number) << row.name << ' ' << fields[i].name;
      EXPECT_TRUE(std::ranges::equal(read[i].bytes, values[i].bytes)) << row.name;
    }
  }
}

TEST(Payload, AMessageHasItsNumbersInTheOrderOfTheRows) {
  EXPECT_EQ(make_async(spec::AsyncId::MacroMarker, {20, 255, 0x0102}),
            (Async{0x06, {20, 255, 0x01, 0x02}}));
  EXPECT_EQ(make_async(spec::AsyncId::Collision, {-1, 2, 0, 1, 3, 4, 5, 6}).data.size(), 16U);
}

TEST(Payload, EveryNumberOutsideItsRangeIsRefusedWith07) {
  for (const auto& row : spec::api_commands) {
    const auto fields = spec::operands(row.command);
    for (std::size_t wrong = 0; wrong < fields.size(); ++wrong) {
      const auto bits = spec::field_size(fields[wrong].type) * 8;
      if (!spec::is_number(fields[wrong].type) || bits >= 32 ||
          fields[wrong].most >= (std::int64_t{1} << bits) - 1 || fields[wrong].least < 0)
        continue; // every value of these bits is in range
      Bytes data;
      for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto value = i == wrong ? fields[i].most + 1 : fields[i].least;
        if (fields[i].type == spec::FieldType::Data)
          data.resize(data.size() + static_cast<std::size_t>(fields[i].least));
        else if (spec::field_size(fields[i].type) == 1)
          data.push_back(static_cast<std::uint8_t>(value));
        else if (spec::field_size(fields[i].type) == 2)
          append_u16(data, static_cast<std::uint32_t>(value));
        else
          append_u32(data, static_cast<std::uint32_t>(value));
      }
      const auto operands = Operands::read(row.command, data);
      ASSERT_FALSE(operands) << row.name << " " << fields[wrong].name;
      EXPECT_EQ(operands.error().code, ResponseCode::BadParameter) << row.name;
      EXPECT_EQ(operands.error().field, &fields[wrong]) << row.name;
    }
  }
}

TEST(Payload, AByteTooFewOrTooManyIsRefusedWith06) {
  for (const auto& row : spec::api_commands) {
    std::size_t size = 0;
    bool open = false;
    for (const auto& field : spec::operands(row.command)) {
      size += spec::field_size(field.type);
      open |= field.type == spec::FieldType::Data || field.presence == spec::Presence::Optional;
    }
    if (open)
      continue;
    const auto longer = Operands::read(row.command, Bytes(size + 1));
    ASSERT_FALSE(longer) << row.name;
    EXPECT_EQ(longer.error().code, ResponseCode::BadMessage) << row.name;
    if (size == 0)
      continue;
    const auto shorter = Operands::read(row.command, Bytes(size - 1));
    ASSERT_FALSE(shorter) << row.name;
    EXPECT_EQ(shorter.error().code, ResponseCode::BadMessage) << row.name;
  }
}

TEST(Payload, SetDataStreamingHasNineOrThirteenBytes) {
  EXPECT_TRUE(Operands::read(ApiCommand::SetDataStreaming, Bytes(9)));
  EXPECT_TRUE(Operands::read(ApiCommand::SetDataStreaming, Bytes(13)));
  EXPECT_FALSE(Operands::read(ApiCommand::SetDataStreaming, Bytes(8)));
  EXPECT_FALSE(Operands::read(ApiCommand::SetDataStreaming, Bytes(11)));
}

TEST(Payload, SaysWhatIsWrong) {
  const auto message = [](ApiCommand command, std::string_view text) {
    const auto payload = encode_operands(command, words(text));
    return payload ? std::string() : payload.error().message;
  };
  EXPECT_EQ(message(ApiCommand::Roll, "300 0"), "`speed` takes 0 to 255, found 300");
  EXPECT_EQ(message(ApiCommand::Roll, "fast 0"), "`speed` takes a number, found `fast`");
  EXPECT_EQ(message(ApiCommand::Roll, "1"),
            "`roll` takes 2 to 4 operands, found 1; write `roll SPEED HEADING [GO] [PADDING]`");
  EXPECT_EQ(message(ApiCommand::SaveMacro, "20 01 zz"), "`macro` takes hex bytes, found `zz`");
}

TEST(Payload, TakesNamesForValues) {
  EXPECT_EQ(encode_operands(ApiCommand::EraseOrbbasicStorage, words("flash")).value(), Bytes{1});
  EXPECT_EQ(encode_operands(ApiCommand::SetStabilization, words("off")).value(), Bytes{0});
  EXPECT_EQ(encode_operands(ApiCommand::SetRawMotorValues, words("forward 9 ignore 0")).value(),
            (Bytes{1, 9, 4, 0}));
}

TEST(Payload, FixedBytesAreFilledUpOrCut) {
  const auto fields = spec::answer(ApiCommand::GetBluetoothInfo);
  const FieldContent contents[] = {as_bytes("Red"), as_bytes("0123456789ABCDEF"), 0, 1, 2, 3};
  const auto data = write_fields(fields, contents);
  EXPECT_EQ(as_text(data), std::string_view("Red\0\0\0\0\0\0\0\0\0\0\0\0\0"
                                            "0123456789AB\0\1\2\3",
                                            32));
}

} // namespace
} // namespace orb::protocol
