#include "spec/api.h"
#include "spec/firmware.h"

#include <gtest/gtest.h>

namespace orb::spec {
namespace {

TEST(Api, EveryRowIsFoundByNumberAndName) {
  for (const auto& row : api_commands) {
    EXPECT_EQ(find_command(did(row.command), cid(row.command)), &row);
    EXPECT_EQ(find_command(row.name), &row);
    EXPECT_EQ(&info(row.command), &row);
  }
  EXPECT_EQ(find_command(0x02, 0x0F), nullptr);
  EXPECT_EQ(find_command("frobnicate"), nullptr);
}

TEST(Api, OptionalOperandsStandLastAndDataTakesTheRest) {
  for (const auto& row : api_commands) {
    bool optional = false;
    for (const auto& field : operands(row.command)) {
      EXPECT_TRUE(!optional || field.presence == Presence::Optional) << row.name;
      optional |= field.presence == Presence::Optional;
      EXPECT_LE(field.least, field.most) << row.name << " " << field.name;
      if (field.type == FieldType::Data) {
        EXPECT_EQ(&field, &operands(row.command).back()) << row.name;
      }
    }
  }
}

TEST(Api, SizesAreThoseOfTheDocument) {
  const auto size = [](std::span<const Field> fields) {
    std::size_t sum = 0;
    for (const auto& field : fields)
      sum += field_size(field.type);
    return sum;
  };
  EXPECT_EQ(size(answer(ApiCommand::GetVersioning)), 10u);
  EXPECT_EQ(size(answer(ApiCommand::GetBluetoothInfo)), 32u);
  EXPECT_EQ(size(answer(ApiCommand::GetPowerState)), 8u);
  EXPECT_EQ(size(answer(ApiCommand::PerformLevel2Diagnostics)), 0x58u);
  EXPECT_EQ(size(answer(ApiCommand::PollPacketTimes)), 12u);
  EXPECT_EQ(size(operands(ApiCommand::SetDataStreaming)), 13u);
  EXPECT_EQ(size(operands(ApiCommand::Sleep)), 5u);
  EXPECT_EQ(size(operands(ApiCommand::ConfigureLocator)), 7u);
  EXPECT_EQ(size(answer(ApiCommand::ReadLocator)), 10u);
  EXPECT_EQ(size(fields(AsyncId::Collision)), 16u);
}

TEST(Api, LongPayloadsAreTheirOperands) {
  for (const auto& row : api_commands) {
    const auto fixed = long_payload(did(row.command), cid(row.command));
    if (fixed == 0)
      continue;
    std::size_t sum = 0;
    for (const auto& field : operands(row.command))
      sum += field.type == FieldType::Data ? static_cast<std::size_t>(field.most)
                                           : field_size(field.type);
    EXPECT_EQ(sum, fixed) << row.name;
  }
}

TEST(Api, StreamBitsAreUnique) {
  std::uint64_t seen = 0;
  for (const auto& row : streams) {
    EXPECT_EQ(seen & row.mask, 0u) << row.name;
    seen |= row.mask;
  }
  EXPECT_EQ(seen, 0xFF80'0000'FC7F'FC60u);
}

TEST(Api, NamesValuesAndBits) {
  EXPECT_EQ(value_name("power state", power_state::charging), "charging");
  EXPECT_EQ(value_name("power state", 9), "");
  EXPECT_EQ(bit_names("axis flags", 3), "X, Y");
}

TEST(Firmware, TheDefaultAnswersTheDocumentedRecord) {
  const auto record = info(default_firmware).record();
  EXPECT_EQ(
      (std::vector<std::uint8_t>{record.begin(), record.end()}),
      (std::vector<std::uint8_t>{0x02, 0x02, 0x03, 0x03, 0x33, 0x21, 0x16, 0x04, 0x01, 0x32}));
  EXPECT_FALSE(find_firmware("bb-8")->has_orbbasic());
  EXPECT_EQ(find_firmware("bb-8")->record().size(), 8u);
}

TEST(Firmware, RecordsOfTenBytesCarryTheirApiRevision) {
  for (const auto& row : firmwares)
    if (row.record().size() == version_record_max) {
      EXPECT_EQ(row.record()[version_api_at], row.api.major) << row.name;
      EXPECT_EQ(row.record()[version_api_at + 1], row.api.minor) << row.name;
    }
}

} // namespace
} // namespace orb::spec
