#include "protocol/judge/order.h"

#include "protocol/describe_v2.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"

#include <fmt/format.h>

namespace orb::protocol {
namespace {

using spec::ApiCommand;
using spec::V2Command;

/// Commands that are often polled, and those that make the robot report by itself.
constexpr struct {
  ApiCommand asked;
  ApiCommand instead;
} instead_v1[] = {
    {ApiCommand::ReadLocator, ApiCommand::SetDataStreaming},
    {ApiCommand::GetPowerState, ApiCommand::SetPowerNotification},
};
constexpr struct {
  V2Command asked;
  V2Command instead;
} instead_v2[] = {
    {V2Command::GetVoltageState, V2Command::VoltageNotify},
    {V2Command::GetChargerState, V2Command::ChargerNotify},
    {V2Command::GetInfrared, V2Command::InfraredNotify},
};

Effect effect_of_motors(std::uint8_t left_mode, std::uint8_t right_mode) {
  using namespace spec::motor_mode;
  const auto drives = [](std::uint8_t mode) { return mode == forward || mode == reverse; };
  if (drives(left_mode) || drives(right_mode))
    return Effect::Drives;
  return left_mode == ignore || right_mode == ignore ? Effect::None : Effect::Stops;
}

/// The effects of macros and programs are not judged.
Effect effect_of(ApiCommand command, const Operands& operands) {
  if (command == ApiCommand::Roll) {
    constexpr std::size_t speed = 0;
    constexpr std::size_t go = 2;
    const bool stops =
        operands.number(speed) == 0 || (operands.has(go) && operands.number(go) == 0);
    return stops ? Effect::Stops : Effect::Drives;
  }
  if (command == ApiCommand::SetRawMotorValues)
    return effect_of_motors(operands.u8(0), operands.u8(2));
  if (command == ApiCommand::Boost && operands.u8(0) != 0)
    return Effect::Drives;
  if (command == ApiCommand::Sleep)
    return Effect::Sleeps;
  const bool stops_once =
      command == ApiCommand::SetTemporaryOptionFlags &&
      (operands.number(0) & spec::temporary_option_flags::stop_on_disconnect) != 0;
  return stops_once || command == ApiCommand::SetMotionTimeout ? Effect::EndsSafely : Effect::None;
}

Effect effect_of(V2Command command, ByteView data) {
  if (command == V2Command::DriveWithHeading)
    return data[0] == 0 ? Effect::Stops : Effect::Drives;
  if (command == V2Command::RawMotors)
    return effect_of_motors(data[0], data[2]);
  if (command == V2Command::Wake)
    return Effect::Wakes;
  return command == V2Command::Sleep || command == V2Command::DeepSleep ? Effect::Sleeps
                                                                        : Effect::None;
}

std::string ids(std::uint8_t did, std::uint8_t cid) {
  return fmt::format("{:02X}h {:02X}h", did, cid);
}

std::uint32_t key_of(const PacketV2& packet) {
  return static_cast<std::uint32_t>(packet.did << 16 | packet.cid << 8 | packet.seq);
}

Refusal refusal_of(spec::ResponseCode code, std::uint8_t number) {
  const auto* row = spec::find_response(number);
  Refusal refusal;
  refusal.error = fmt::format("{:02X}h, {}", number, row == nullptr ? "unknown" : row->meaning);
  if (code == spec::ResponseCode::BadChecksum || code == spec::ResponseCode::Fragment)
    refusal.why = Refusal::Why::Link;
  else if (code == spec::ResponseCode::BadCommand || code == spec::ResponseCode::BadDevice)
    refusal.why = Refusal::Why::Unknown;
  return refusal;
}

Refusal refusal_of(spec::V2Error error, std::uint8_t did) {
  const auto number = static_cast<std::uint8_t>(error);
  const auto* row = spec::find_v2_error(number);
  Refusal refusal;
  refusal.error = fmt::format("{:02X}h, {}", number, row == nullptr ? "unknown" : row->meaning);
  if (error == spec::V2Error::BadCommand || error == spec::V2Error::BadDevice)
    refusal.why = Refusal::Why::Unknown;
  else if (error == spec::V2Error::TargetUnavailable && !serves_asleep(did))
    refusal.why = Refusal::Why::Asleep;
  return refusal;
}

} // namespace

Order order_of(const Item& item) {
  Order order;
  order.key = order.seq = item.seq;
  order.answers = (item.flags & spec::sop2_answer) != 0 ? Answers::Always : Answers::Never;
  const auto* row = spec::find_command(item.did, item.cid);
  order.name = row == nullptr ? ids(item.did, item.cid) : std::string(row->name);
  if (row == nullptr)
    return order;
  order.is_known = true;
  if (const auto operands = Operands::read(row->command, item.data))
    order.effect = effect_of(row->command, *operands);
  for (const auto& [asked, instead] : instead_v1)
    if (asked == row->command)
      order.instead = spec::info(instead).name;
  return order;
}

Order order_of(const PacketV2& packet) {
  Order order;
  order.key = key_of(packet);
  order.seq = packet.seq;
  const bool asks = spec::has(packet.flags, spec::V2Flag::RequestResponse);
  const bool errors = spec::has(packet.flags, spec::V2Flag::OnlyErrorResponse);
  order.answers = !asks ? Answers::Never : errors ? Answers::Errors : Answers::Always;
  order.needs_waking = !serves_asleep(packet.did);
  const auto* row = spec::find_v2_command(packet.did, packet.cid);
  order.name = row == nullptr ? ids(packet.did, packet.cid) : std::string(row->name);
  if (row == nullptr)
    return order;
  order.is_known = true;
  if (fits(row->command, packet.data))
    order.effect = effect_of(row->command, packet.data);
  for (const auto& [asked, instead] : instead_v2)
    if (asked == row->command)
      order.instead = spec::info(instead).name;
  return order;
}

Reply reply_of(const Item& item) {
  Reply reply;
  reply.key = item.seq;
  const auto code = static_cast<spec::ResponseCode>(item.code);
  if (code != spec::ResponseCode::Ok)
    reply.refusal = refusal_of(code, item.code);
  return reply;
}

Reply reply_of(const PacketV2& packet) {
  Reply reply;
  reply.key = key_of(packet);
  const auto error = static_cast<spec::V2Error>(packet.error);
  if (error != spec::V2Error::Success)
    reply.refusal = refusal_of(error, packet.did);
  return reply;
}

std::optional<Refusal> refusal_of(const Item& item) {
  const auto* row = spec::find_command(item.did, item.cid);
  if (row == nullptr)
    return std::nullopt;
  const auto operands = Operands::read(row->command, item.data);
  if (operands)
    return std::nullopt;
  return refusal_of(operands.error().code, static_cast<std::uint8_t>(operands.error().code));
}

std::optional<Refusal> refusal_of(const PacketV2& packet, std::optional<spec::Robot> robot) {
  const auto* row = spec::find_v2_command(packet.did, packet.cid);
  if (row == nullptr)
    return std::nullopt; // robots have commands that are not in the table
  const auto error =
      robot ? refusal(packet, spec::info(*robot)) : refusal(row->command, packet.data);
  if (error == spec::V2Error::Success)
    return std::nullopt;
  return refusal_of(error, packet.did);
}

} // namespace orb::protocol
