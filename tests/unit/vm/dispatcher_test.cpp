#include "vm/api/dispatcher.h"

#include "compiler/load.h"
#include "vm/ball.h"

#include <gtest/gtest.h>
#include <memory>

namespace orb::vm {
namespace {

using protocol::Item;
using spec::ApiCommand;
using spec::AsyncId;
using spec::ResponseCode;

/// A packet from the ball, with bytes of its own.
struct Packet {
  bool is_answer = false;
  std::uint8_t code = 0; ///< MRSP or message id
  std::uint8_t seq = 0;
  Bytes data;
};

/// A ball with a client that talks to it in virtual time.
class Client {
public:
  explicit Client(spec::Firmware firmware = spec::default_firmware) {
    BallOptions options;
    options.firmware = firmware;
    options.loader = compiler::load;
    ball = std::make_unique<Ball>(options);
    ball->connect();
  }

  /// Sends bytes. Returns what the ball sends within `time`.
  std::vector<Packet> send(const Bytes& bytes, Duration time = 1s) {
    ball->receive(bytes);
    return wait(time);
  }

  std::vector<Packet> wait(Duration time) {
    ball->advance_to(ball->now() + time);
    const auto bytes = ball->take_output();
    decoder_.feed(bytes);
    std::vector<Packet> packets;
    while (const auto item = decoder_.next()) {
      EXPECT_NE(item->kind, Item::Kind::Noise);
      packets.push_back({item->kind == Item::Kind::Response,
                         item->code,
                         item->seq,
                         {item->data.begin(), item->data.end()}});
    }
    return packets;
  }

  /// Sends a command. Returns its answer, which must come first.
  Packet ask(ApiCommand command, Bytes data = {}, Duration time = 1s) {
    const auto seq = ++seq_;
    rest = send(encode(protocol::make_command(command, std::move(data), seq)), time);
    // Skip data sent before the command.
    while (!rest.empty() && !rest.front().is_answer &&
           rest.front().code == static_cast<std::uint8_t>(AsyncId::SensorData))
      rest.erase(rest.begin());
    if (rest.empty() || !rest.front().is_answer || rest.front().seq != seq) {
      ADD_FAILURE() << spec::info(command).name << " was not answered first";
      return {};
    }
    auto answer = rest.front();
    rest.erase(rest.begin());
    return answer;
  }

  ResponseCode code(ApiCommand command, Bytes data = {}) {
    return static_cast<ResponseCode>(ask(command, std::move(data), 50ms).code);
  }

  /// Returns the messages of an id that came with or after the last answer.
  std::vector<Packet> messages(AsyncId id) const {
    std::vector<Packet> out;
    for (const auto& packet : rest)
      if (!packet.is_answer && packet.code == static_cast<std::uint8_t>(id))
        out.push_back(packet);
    return out;
  }

  void watch(Duration time) { rest = wait(time); }

  std::unique_ptr<Ball> ball;
  std::vector<Packet> rest;

private:
  protocol::Decoder decoder_{protocol::Direction::FromBall};
  std::uint8_t seq_ = 0;
};

/// Returns valid operands, as many as the command takes.
Bytes least_operands(const spec::CommandInfo& row) {
  Bytes data;
  for (const auto& field : spec::operands(row.command)) {
    const auto value = static_cast<std::uint32_t>(field.least);
    switch (spec::field_size(field.type)) {
    case 1: data.push_back(static_cast<std::uint8_t>(value)); break;
    case 2: append_u16(data, value); break;
    case 4: append_u32(data, value); break;
    default: data.resize(data.size() + static_cast<std::size_t>(field.least));
    }
  }
  return data;
}

TEST(Dispatcher, RefusesWhatItsRowsSay) {
  for (const auto& row : spec::api_commands) {
    if (row.command == ApiCommand::LeaveBootloader)
      continue;
    Client client;
    const auto code = client.code(row.command, least_operands(row));
    switch (row.status) {
    case spec::Status::Implemented:
      EXPECT_NE(code, ResponseCode::BadCommand) << row.name;
      EXPECT_NE(code, ResponseCode::BadMessage) << row.name;
      EXPECT_NE(code, ResponseCode::Unsupported) << row.name;
      break;
    case spec::Status::Factory:
    case spec::Status::Unsupported: EXPECT_EQ(code, ResponseCode::Unsupported) << row.name; break;
    case spec::Status::Password: EXPECT_EQ(code, ResponseCode::BadPassword) << row.name; break;
    case spec::Status::Bootloader: EXPECT_EQ(code, ResponseCode::BadDevice) << row.name; break;
    }
  }
}

TEST(Dispatcher, AnswersOfImplementedCommandsHaveTheSizeOfTheirRow) {
  for (const auto& row : spec::api_commands) {
    Client client;
    const auto answer = client.ask(row.command, least_operands(row), 50ms);
    if (answer.code != 0)
      continue;
    std::size_t size = 0;
    for (const auto& field : spec::answer(row.command))
      size += spec::field_size(field.type);
    EXPECT_EQ(answer.data.size(), size) << row.name;
  }
}

TEST(Dispatcher, TellsUnknownDevicesCommandsLengthsAndRanges) {
  Client client;
  const auto code = [&](protocol::Command command) {
    const auto packets = client.send(encode(command), 50ms);
    return packets.size() == 1 ? packets[0].code : 0xFF;
  };
  EXPECT_EQ(code({.did = 3, .cid = 1, .seq = 0, .data = {}}), 0x09);
  EXPECT_EQ(code({.did = 1, .cid = 4, .seq = 0, .data = {}}), 0x09);
  EXPECT_EQ(code({.did = 0, .cid = 0x7F, .seq = 0, .data = {}}), 0x04);
  EXPECT_EQ(code({.did = 0, .cid = 1, .seq = 0, .data = {1}}), 0x06);
  EXPECT_EQ(code({.did = 2, .cid = 1, .seq = 0, .data = {0x01, 0x68}}), 0x07);
}

TEST(Dispatcher, ABadChecksumIsAnsweredWith02) {
  Client client;
  auto bytes = encode(protocol::make_command(ApiCommand::Ping, {}, 9));
  bytes.back() ^= 0x10;
  const auto packets = client.send(bytes);
  ASSERT_GE(packets.size(), 1u);
  EXPECT_EQ(packets[0].code, 0x02);
  EXPECT_EQ(packets[0].seq, 9);
}

TEST(Dispatcher, AHalfPacketIsDroppedAfter500MsAndAPingThenAnswered) {
  Client client;
  EXPECT_TRUE(client.send({0xFF, 0xFF, 0x02, 0x61, 0x07, 0x50, 0x00}, 499ms).empty());
  const auto packets = client.wait(2ms);
  ASSERT_EQ(packets.size(), 1u);
  EXPECT_EQ(packets[0].code, 0x03);
  EXPECT_EQ(packets[0].seq, 7);
  EXPECT_EQ(client.code(ApiCommand::Ping), ResponseCode::Ok);
}

TEST(Dispatcher, WithoutTheAnswerBitItActsInSilence) {
  Client client;
  auto command = protocol::make_command(ApiCommand::SetRgbLed, {1, 2, 3, 1});
  command.flags = 0xFE;
  EXPECT_TRUE(client.send(encode(command)).empty());
  EXPECT_EQ(client.ask(ApiCommand::GetRgbLed).data, (Bytes{1, 2, 3}));
}

TEST(Dispatcher, GetRgbReturnsTheUserColourOnly) {
  Client client;
  client.ask(ApiCommand::SetRgbLed, {9, 9, 9, 1});
  client.ask(ApiCommand::SetRgbLed, {1, 2, 3}); // three bytes: a leniency
  EXPECT_EQ(client.ball->led(), (Color{1, 2, 3}));
  EXPECT_EQ(client.ask(ApiCommand::GetRgbLed).data, (Bytes{9, 9, 9}));
}

TEST(Dispatcher, NamesKeep48BytesAndReport16WithoutCuttingACharacter) {
  Client client;
  const std::string name = "fifteen letters\xC3\xA9 and a tail that goes on and on and on";
  client.ask(ApiCommand::SetDeviceName, {name.begin(), name.end()});
  auto info = client.ask(ApiCommand::GetBluetoothInfo).data;
  ASSERT_EQ(info.size(), 32u);
  EXPECT_EQ(std::string(info.begin(), info.begin() + 16), std::string("fifteen letters\0", 16));
  EXPECT_EQ(client.ball->profile().name, name.substr(0, 48));
}

TEST(Dispatcher, TripPointsKeepTheirDistance) {
  Client client;
  EXPECT_EQ(client.code(ApiCommand::SetVoltageTripPoints, {0x02, 0xA3, 0x02, 0xA3}),
            ResponseCode::BadParameter); // 675 and 675
  EXPECT_EQ(client.code(ApiCommand::SetVoltageTripPoints, {0x02, 0xA3, 0x02, 0x8A}),
            ResponseCode::Ok); // 675 and 650
  EXPECT_EQ(client.ask(ApiCommand::GetVoltageTripPoints).data, (Bytes{0x02, 0xA3, 0x02, 0x8A}));
}

TEST(Dispatcher, PowerNotificationsComeEvery10Seconds) {
  Client client;
  client.ask(ApiCommand::SetPowerNotification, {1}, 31s);
  EXPECT_EQ(client.messages(AsyncId::PowerNotification).size(), 3u);
  client.ball->apply(stimulus::Battery{6.9});
  client.watch(1s);
  ASSERT_EQ(client.messages(AsyncId::PowerNotification).size(), 1u);
  EXPECT_EQ(client.rest[0].data, Bytes{spec::power_state::low});
  client.ask(ApiCommand::SetPowerNotification, {0}, 60s);
  EXPECT_TRUE(client.rest.empty());
}

TEST(Dispatcher, OnlyCommandsWithBit1KeepTheBallAwake) {
  Client client;
  client.ask(ApiCommand::SetInactivityTimeout, {0, 60});
  auto ping = protocol::make_command(ApiCommand::Ping);
  ping.flags = spec::sop2_least | spec::sop2_answer;
  client.rest = client.send(encode(ping), 40s);
  client.rest = client.send(encode(ping), 15s);
  EXPECT_EQ(client.messages(AsyncId::PreSleepWarning).size(), 1u);
  client.watch(10s);
  EXPECT_TRUE(client.ball->asleep());

  Client kept;
  kept.ask(ApiCommand::SetInactivityTimeout, {0, 60});
  for (int i = 0; i < 4; ++i)
    kept.ask(ApiCommand::Ping, {}, 45s);
  EXPECT_FALSE(kept.ball->asleep());
}

TEST(Dispatcher, BeforeFirmware126EveryCommandKeepsTheBallAwake) {
  Client client(spec::Firmware::Sphero098);
  EXPECT_EQ(client.code(ApiCommand::SetInactivityTimeout, {0, 60}), ResponseCode::BadCommand);
  auto ping = protocol::make_command(ApiCommand::Ping);
  ping.flags = spec::sop2_least;
  client.send(encode(ping), 590s);
  client.send(encode(ping), 590s);
  EXPECT_FALSE(client.ball->asleep());
}

TEST(Dispatcher, BallsWithoutOrbBasicDoNotKnowItsCommands) {
  Client client(spec::Firmware::Bb8);
  EXPECT_EQ(client.code(ApiCommand::EraseOrbbasicStorage, {0}), ResponseCode::BadCommand);
  EXPECT_EQ(client.ask(ApiCommand::GetVersioning).data.size(), 8u);
}

TEST(Dispatcher, TheBootloaderAnswersDeviceZeroUntilLeft) {
  Client client;
  EXPECT_EQ(client.code(ApiCommand::JumpToBootloader), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::Ping), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::GetRgbLed), ResponseCode::BadDevice);
  EXPECT_EQ(client.code(ApiCommand::BeginReflash), ResponseCode::BadDevice);
  EXPECT_EQ(client.code(ApiCommand::LeaveBootloader), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::GetRgbLed), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::LeaveBootloader), ResponseCode::BadDevice);
}

TEST(Dispatcher, TheBootloaderAnswersAsTheRecordedOneDid) {
  Client client(spec::Firmware::Sphero373);
  EXPECT_EQ(client.ask(ApiCommand::GetVersioning).data,
            (Bytes{0x01, 0x03, 0x01, 0x03, 0x49, 0x33, 0x19, 0x06}));
  const auto says = [&](const Bytes& asked, const Bytes& expected) {
    client.ball->receive(asked);
    client.ball->advance_to(client.ball->now() + 50ms);
    EXPECT_EQ(client.ball->take_output(), expected);
  };
  says({0xFF, 0xFF, 0x00, 0x30, 0x01, 0x01, 0xCD}, {0xFF, 0xFF, 0x00, 0x01, 0x01, 0xFD});
  says({0xFF, 0xFF, 0x01, 0x05, 0x02, 0x02, 0x10, 0xE5},
       {0xFF, 0xFF, 0x00, 0x02, 0x02, 0x00, 0xFB});
  says({0xFF, 0xFF, 0x00, 0x02, 0x01, 0x01, 0xFB},
       {0xFF, 0xFF, 0x00, 0x01, 0x09, 0x01, 0x03, 0x01, 0x00, 0x00, 0x33, 0x00, 0x00, 0xBD});
  says({0xFF, 0xFF, 0x01, 0x04, 0x03, 0x01, 0xF6}, {0xFF, 0xFF, 0x00, 0x03, 0x01, 0xFB});
  EXPECT_EQ(client.ask(ApiCommand::GetVersioning).data[6], 0x19);
}

TEST(Dispatcher, TheBootloaderKnowsThePagesOfItsModel) {
  Client client(spec::Firmware::Sphero373);
  client.ask(ApiCommand::JumpToBootloader);
  EXPECT_EQ(client.code(ApiCommand::IsPageBlank, {5}), ResponseCode::PageIllegal);
  EXPECT_EQ(client.ask(ApiCommand::IsPageBlank, {6}).data, (Bytes{0}));
  EXPECT_EQ(client.ask(ApiCommand::IsPageBlank, {59}).data, (Bytes{0}));
  EXPECT_EQ(client.code(ApiCommand::IsPageBlank, {60}), ResponseCode::PageIllegal);
}

TEST(Dispatcher, WithoutFirmwareTheBootloaderIsNotLeft) {
  Client client(spec::Firmware::Bootloader);
  EXPECT_EQ(client.code(ApiCommand::LeaveBootloader), ResponseCode::MainCorrupt);
  EXPECT_EQ(client.code(ApiCommand::GetRgbLed), ResponseCode::BadDevice);
  EXPECT_EQ(client.ask(ApiCommand::IsPageBlank, {16}).data, (Bytes{1}));
}

TEST(Dispatcher, SomeFirmwareDoesNotTellWhatItHasReceived) {
  for (const auto firmware : {spec::Firmware::Sphero373, spec::Firmware::Bb8})
    EXPECT_EQ(Client(firmware).code(ApiCommand::PerformLevel2Diagnostics),
              ResponseCode::BadCommand);
}

TEST(Dispatcher, BlocksHaveTheSizeOfTheRecordedOnes) {
  Client client;
  for (std::uint8_t block = 0; block < 2; ++block) {
    EXPECT_TRUE(client.ask(ApiCommand::GetConfigurationBlock, {block}).data.empty());
    ASSERT_EQ(client.messages(AsyncId::ConfigBlock).size(), 1u);
    EXPECT_EQ(client.rest[0].data.size(), 1024u);
  }
  EXPECT_TRUE(client.ask(ApiCommand::GetSsb).data.empty());
  EXPECT_EQ(client.rest[0].data.size(), 1024u);
}

TEST(Dispatcher, CountsWhatItReceives) {
  Client client;
  const auto counter = [&](std::size_t at) {
    return read_u32(client.ask(ApiCommand::PerformLevel2Diagnostics).data, at);
  };
  const auto good = counter(0x03);
  client.send(encode(protocol::Command{.did = 9, .cid = 1, .data = {}}));
  client.send(encode(protocol::Command{.did = 0, .cid = 0x66, .data = {}}));
  client.send(encode(protocol::make_command(ApiCommand::Ping, {1})));
  client.send({0xFF, 0xFF, 0x00, 0x01, 0x52, 0x01, 0xAA});
  EXPECT_EQ(counter(0x03), good + 1);
  EXPECT_EQ(counter(0x07), 1u);
  EXPECT_EQ(counter(0x0B), 1u);
  EXPECT_EQ(counter(0x0F), 1u);
  EXPECT_EQ(counter(0x13), 1u);
  EXPECT_EQ(client.code(ApiCommand::ClearCounters), ResponseCode::ExecuteFailed);
  client.ask(ApiCommand::SetDeviceMode, {1});
  EXPECT_EQ(client.code(ApiCommand::ClearCounters), ResponseCode::Ok);
  EXPECT_EQ(counter(0x07), 0u);
}

TEST(Dispatcher, Level1IsAReportInPlainText) {
  Client client;
  client.ask(ApiCommand::PerformLevel1Diagnostics);
  ASSERT_EQ(client.messages(AsyncId::Level1Diagnostics).size(), 1u);
  EXPECT_NE(as_text(client.rest[0].data).find("OrbBasic=1.6"), std::string_view::npos);
}

TEST(Dispatcher, TimesAreStampedByTheAssignedCounter) {
  Client client;
  client.ask(ApiCommand::AssignTimeValue, {0, 0, 0x10, 0}, 500ms);
  const auto times = client.ask(ApiCommand::PollPacketTimes, {1, 2, 3, 4}).data;
  EXPECT_EQ(read_u32(times, 0), 0x01020304u);
  EXPECT_EQ(read_u32(times, 4), 0x1000u + 500);
  EXPECT_EQ(read_u32(times, 8), 0x1000u + 500);
}

TEST(Dispatcher, StreamsFramesOfTheMaskUntilThePacketsAreSent) {
  Client client;
  // N = 40: 10 frames a second, M = 2, odometer X and accelerometer Z, 3 packets.
  client.ask(ApiCommand::SetDataStreaming,
             {0, 40, 0, 2, 0x00, 0x00, 0x20, 0x00, 3, 0x08, 0x00, 0x00, 0x00}, 5s);
  const auto packets = client.messages(AsyncId::SensorData);
  ASSERT_EQ(packets.size(), 3u);
  EXPECT_EQ(packets[0].data, (Bytes{0x10, 0x00, 0, 0, 0x10, 0x00, 0, 0}));
}

TEST(Dispatcher, AZeroMaskStopsStreamingAtOnce) {
  Client client;
  client.ask(ApiCommand::SetDataStreaming, {0, 1, 0, 1, 0xE0, 0, 0, 0, 0});
  EXPECT_GT(client.messages(AsyncId::SensorData).size(), 100u);
  client.ask(ApiCommand::SetDataStreaming, {0, 0, 0, 0, 0, 0, 0, 0, 0}, 5s);
  EXPECT_TRUE(client.messages(AsyncId::SensorData).empty());
  EXPECT_EQ(client.code(ApiCommand::SetDataStreaming, {0, 0, 0, 1, 0xE0, 0, 0, 0, 0}),
            ResponseCode::BadParameter);
}

TEST(Dispatcher, SelfLevellingSucceedsTimesOutAndAborts) {
  Client client;
  client.ask(ApiCommand::SelfLevel, {1, 0, 0, 0});
  ASSERT_EQ(client.messages(AsyncId::SelfLevelResult).size(), 1u);
  EXPECT_EQ(client.rest[0].data, Bytes{spec::self_level_result::success});
  EXPECT_FALSE(client.ball->body().stabilized());

  client.ball->apply(stimulus::Tilt{20, 0});
  client.ask(ApiCommand::SelfLevel, {1, 0, 2, 0}, 3s);
  ASSERT_EQ(client.messages(AsyncId::SelfLevelResult).size(), 1u);
  EXPECT_EQ(client.rest[0].data, Bytes{spec::self_level_result::timed_out});

  client.ask(ApiCommand::SelfLevel, {9, 0, 200, 0});
  client.ask(ApiCommand::SelfLevel, {0, 0, 0, 0});
  ASSERT_EQ(client.messages(AsyncId::SelfLevelResult).size(), 1u);
  EXPECT_EQ(client.rest[0].data, Bytes{spec::self_level_result::aborted});

  client.ask(ApiCommand::SetPermanentOptionFlags, {0, 0, 0, 4});
  client.ask(ApiCommand::SelfLevel, {1, 0, 0, 0});
  ASSERT_EQ(client.messages(AsyncId::SelfLevelResult).size(), 1u);
  EXPECT_EQ(client.rest[0].data, Bytes{spec::self_level_result::disabled});
}

TEST(Dispatcher, GyroLimitsAreReportedOnceUntilSetHeading) {
  Client client;
  client.ask(ApiCommand::SetPermanentOptionFlags, {0, 0, 1, 0});
  client.ask(ApiCommand::Roll, {0, 0, 180, 1});
  ASSERT_EQ(client.messages(AsyncId::GyroLimit).size(), 1u);
  EXPECT_EQ(client.rest[0].data, Bytes{spec::gyro_axis_flags::z_positive});
  client.ask(ApiCommand::Roll, {0, 0x01, 0x0E, 1});
  EXPECT_TRUE(client.messages(AsyncId::GyroLimit).empty());
  client.ask(ApiCommand::SetHeading, {0, 0});
  client.ask(ApiCommand::Roll, {0, 0, 180, 1});
  EXPECT_EQ(client.messages(AsyncId::GyroLimit).size(), 1u);
}

TEST(Dispatcher, SoulMessagesComeWhenAskedFor) {
  Client client;
  client.ask(ApiCommand::EnableSsbAsync, {1});
  client.ask(ApiCommand::Boost, {1}, 2500ms);
  EXPECT_GE(client.messages(AsyncId::BoostUpdate).size(), 2u);
  client.ask(ApiCommand::Roll, {50, 0, 0, 1}, 70s);
  EXPECT_FALSE(client.messages(AsyncId::XpUpdate).empty());
  ASSERT_EQ(client.messages(AsyncId::LevelUp).size(), 1u);
  EXPECT_EQ(client.messages(AsyncId::LevelUp)[0].data, (Bytes{0, 2, 0, 1}));
  client.ask(ApiCommand::ConfigureCollisionDetection, {1, 50, 0, 50, 0, 10});
  client.ball->apply(stimulus::Push{0, 200});
  client.watch(3s);
  EXPECT_EQ(client.messages(AsyncId::Collision).size(), 1u);
  EXPECT_GE(client.messages(AsyncId::ShieldDamage).size(), 2u);
}

TEST(Dispatcher, CoresPayForBanksAndConsumables) {
  Client client;
  EXPECT_EQ(read_u32(client.ask(ApiCommand::RefillBank, {0}).data, 0), 490u);
  EXPECT_EQ(client.ask(ApiCommand::BuyConsumable, {3, 2}).data, (Bytes{2, 0, 0, 0x01, 0xB8}));
  EXPECT_EQ(client.code(ApiCommand::BuyConsumable, {3, 250}), ResponseCode::ExecuteFailed);
  EXPECT_EQ(client.ask(ApiCommand::UseConsumable, {3}, 10ms).data, (Bytes{3, 1}));
  EXPECT_EQ(client.code(ApiCommand::UseConsumable, {3}), ResponseCode::ExecuteFailed);
  EXPECT_EQ(client.code(ApiCommand::UseConsumable, {4}), ResponseCode::ExecuteFailed);
}

TEST(Dispatcher, ConfigurationBlocksComeBackAsTheyWent) {
  Client client;
  client.ask(ApiCommand::SetRgbLed, {7, 8, 9, 1});
  client.ask(ApiCommand::GetConfigurationBlock, {1});
  ASSERT_EQ(client.messages(AsyncId::ConfigBlock).size(), 1u);
  const auto block = client.rest[0].data;
  client.ask(ApiCommand::SetRgbLed, {1, 1, 1, 1});
  EXPECT_EQ(client.code(ApiCommand::SetConfigurationBlock, block), ResponseCode::Ok);
  EXPECT_EQ(client.ask(ApiCommand::GetRgbLed).data, (Bytes{7, 8, 9}));
  EXPECT_EQ(client.code(ApiCommand::SetConfigurationBlock, Bytes(spec::config_block_size)),
            ResponseCode::BadParameter);
  client.ask(ApiCommand::GetSsb);
  ASSERT_EQ(client.messages(AsyncId::SoulBlock).size(), 1u);
  EXPECT_EQ(client.rest[0].data.size(), spec::ssb_size);
}

TEST(Dispatcher, MacrosAnswerAndMarkAsTheRecordedSessionsDid) {
  Client client;
  EXPECT_EQ(client.code(ApiCommand::ReinitMacroExecutive), ResponseCode::Ok);
  EXPECT_EQ(client.ask(ApiCommand::AbortMacro).data, (Bytes{0, 0, 0}));
  EXPECT_EQ(client.code(ApiCommand::SaveTemporaryMacro, {0xFF, 0x14, 0x15, 0xAA, 0x15, 0xBB, 0x00}),
            ResponseCode::Ok);
  client.ask(ApiCommand::RunMacro, {0xFF});
  const auto markers = client.messages(AsyncId::MacroMarker);
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].data, (Bytes{0xAA, 0xFF, 0, 1}));
  EXPECT_EQ(markers[1].data, (Bytes{0xBB, 0xFF, 0, 2}));
  EXPECT_EQ(markers[2].data, (Bytes{0x00, 0xFF, 0, 3}));
  EXPECT_EQ(client.code(ApiCommand::RunMacro, {77}), ResponseCode::ExecuteFailed);
}

/// Uploads a program to RAM.
void upload(Client& client, std::string_view text) {
  Bytes data{spec::area::ram};
  data.insert(data.end(), text.begin(), text.end());
  data.push_back(0);
  EXPECT_EQ(client.code(ApiCommand::EraseOrbbasicStorage, {spec::area::ram}), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::AppendOrbbasicFragment, data), ResponseCode::Ok);
}

TEST(Dispatcher, ProgramsPrintAfterTheAnswerAndReportErrorsTwice) {
  Client client;
  upload(client, "10 print \"hi\"\n20 A = 1/0\n");
  EXPECT_EQ(client.ask(ApiCommand::ExecuteOrbbasicProgram, {0, 0, 10}).code, 0);
  ASSERT_EQ(client.messages(AsyncId::BasicPrint).size(), 1u);
  EXPECT_EQ(as_text(client.messages(AsyncId::BasicPrint)[0].data), "hi\n");
  ASSERT_EQ(client.messages(AsyncId::BasicErrorText).size(), 1u);
  ASSERT_EQ(client.messages(AsyncId::BasicError).size(), 1u);
  EXPECT_EQ(client.messages(AsyncId::BasicError)[0].data, (Bytes{0, 20, 0, 8}));
}

TEST(Dispatcher, AbortingAProgramIsAnsweredThenReportedAsUserAbort) {
  Client client;
  upload(client, "10 goto 10\n");
  client.ask(ApiCommand::ExecuteOrbbasicProgram, {0, 0, 10});
  EXPECT_EQ(client.code(ApiCommand::ExecuteOrbbasicProgram, {0, 0, 10}),
            ResponseCode::ExecuteFailed);
  EXPECT_EQ(client.code(ApiCommand::EraseOrbbasicStorage, {0}), ResponseCode::ExecuteFailed);
  EXPECT_EQ(client.code(ApiCommand::AppendOrbbasicFragment, {0, 'x'}), ResponseCode::ExecuteFailed);
  client.ask(ApiCommand::AbortOrbbasicProgram);
  ASSERT_EQ(client.messages(AsyncId::BasicError).size(), 1u);
  EXPECT_EQ(client.messages(AsyncId::BasicError)[0].data, (Bytes{0, 10, 0, 0x0D}));
}

TEST(Dispatcher, CommitCopiesRamToFlashUnderBothNumbers) {
  for (const auto command : {ApiCommand::CommitRamToFlash, ApiCommand::CommitRamToFlash70}) {
    Client client;
    upload(client, "10 goto 10\n");
    EXPECT_EQ(client.code(command), ResponseCode::Ok);
    EXPECT_EQ(client.ball->basic_text(Area::Flash), client.ball->basic_text(Area::Ram));
    client.ask(ApiCommand::ExecuteOrbbasicProgram, {1, 0, 10});
    EXPECT_EQ(client.code(command), ResponseCode::ExecuteFailed);
  }
}

TEST(Dispatcher, AFullAreaRefusesAFragmentWhole) {
  Client client;
  const Bytes line(253, ' ');
  Bytes data{0};
  data.insert(data.end(), line.begin(), line.end());
  for (int i = 0; i < 16; ++i)
    EXPECT_EQ(client.code(ApiCommand::AppendOrbbasicFragment, data), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::AppendOrbbasicFragment, data), ResponseCode::ExecuteFailed);
  EXPECT_EQ(client.ball->basic_text(Area::Ram).size(), 16u * 253);
  EXPECT_EQ(client.code(ApiCommand::EraseOrbbasicStorage, {2}), ResponseCode::BadParameter);
}

TEST(Dispatcher, StopOnDisconnectIsObeyedOnce) {
  Client client;
  client.ask(ApiCommand::SetTemporaryOptionFlags, {0xFF, 0xFF, 0xFF, 0xFF});
  EXPECT_EQ(client.ask(ApiCommand::GetTemporaryOptionFlags).data, (Bytes{0, 0, 0, 1}));
  client.ask(ApiCommand::Roll, {100, 0, 0, 1});
  client.ball->disconnect();
  client.ball->advance_to(client.ball->now() + 3s);
  EXPECT_TRUE(client.ball->body().stopped());
  client.ball->connect();
  EXPECT_EQ(client.ask(ApiCommand::GetTemporaryOptionFlags).data, (Bytes{0, 0, 0, 0}));
  client.ask(ApiCommand::Roll, {100, 0, 0, 1});
  client.ball->disconnect();
  client.ball->advance_to(client.ball->now() + 3s);
  EXPECT_FALSE(client.ball->body().stopped());
}

TEST(Dispatcher, SleepEndsTheMacroOfAConsumable) {
  Client client;
  client.ask(ApiCommand::BuyConsumable, {3, 2});
  EXPECT_EQ(client.code(ApiCommand::UseConsumable, {3}), ResponseCode::Ok);
  EXPECT_EQ(client.code(ApiCommand::Sleep, {0, 1, 0, 0, 0}), ResponseCode::Ok);
  client.watch(1s);
  client.ball->connect();
  EXPECT_EQ(client.code(ApiCommand::UseConsumable, {3}), ResponseCode::Ok);
}

TEST(Dispatcher, SleepIsAnsweredThenObeyedAndWakesByItself) {
  Client client;
  EXPECT_EQ(client.code(ApiCommand::Sleep, {0xFF, 0xFF, 0, 0, 0}), ResponseCode::Unsupported);
  EXPECT_EQ(client.code(ApiCommand::Sleep, {0, 5, 0, 0, 0}), ResponseCode::Ok);
  EXPECT_TRUE(client.ball->asleep());
  EXPECT_TRUE(client.send(encode(protocol::make_command(ApiCommand::Ping))).empty());
  client.watch(5s);
  EXPECT_FALSE(client.ball->asleep());
}

TEST(Dispatcher, LocatorFollowsSetHeadingUnlessToldNotTo) {
  Client client;
  client.ask(ApiCommand::SetHeading, {0, 0});
  client.ask(ApiCommand::Roll, {0, 0, 90, 1});
  client.ask(ApiCommand::SetHeading, {0, 0}); // renames 90 to 0
  client.ask(ApiCommand::Roll, {100, 0, 0, 1}, 2s);
  const auto place = client.ask(ApiCommand::ReadLocator).data;
  EXPECT_GT(static_cast<std::int16_t>(read_u16(place, 0)), 50); // still to the right
  EXPECT_LT(std::abs(static_cast<std::int16_t>(read_u16(place, 2))), 5);
}

} // namespace
} // namespace orb::vm
