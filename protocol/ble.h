#pragma once

#include "spec/ble.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::protocol {

/// The steps to a robot over Bluetooth LE, in order.
enum class BleStep : std::uint8_t {
  Bus,      ///< the computer's Bluetooth service answers
  Adapter,  ///< its radio is on
  Find,     ///< the robot is found
  Connect,  ///< the robot is connected
  Services, ///< its characteristics are known
  AntiDos,  ///< the three words of spec/ble.def, from here
  TxPower,
  Wake,     ///< … to here
  Subscribe ///< its packets arrive as notifications
};

struct BleStepInfo {
  BleStep step;
  std::string_view word;  ///< used in fault plans
  std::string_view doing; ///< used in messages: "the link was lost while …"
};

inline constexpr auto ble_steps = std::to_array<BleStepInfo>({
    {BleStep::Bus, "bus", "looking for bluetoothd"},
    {BleStep::Adapter, "adapter", "looking for an adapter"},
    {BleStep::Find, "find", "looking for the robot"},
    {BleStep::Connect, "connect", "connecting"},
    {BleStep::Services, "services", "asking what the robot can do"},
    {BleStep::AntiDos, "anti-dos", "unlocking the robot for commands"},
    {BleStep::TxPower, "tx-power", "setting its transmit power"},
    {BleStep::Wake, "wake", "waking the robot"},
    {BleStep::Subscribe, "subscribe", "subscribing to its answers"},
});

constexpr const BleStepInfo& info(BleStep step) {
  return ble_steps[static_cast<std::size_t>(step)];
}

/// Returns the step that writes to a characteristic; nullopt if none does.
constexpr std::optional<BleStep> step_of(spec::BleCharacteristic characteristic) {
  switch (characteristic) {
  case spec::BleCharacteristic::AntiDos:
  case spec::BleCharacteristic::AntiDosV2: return BleStep::AntiDos;
  case spec::BleCharacteristic::TxPower: return BleStep::TxPower;
  case spec::BleCharacteristic::Wake: return BleStep::Wake;
  case spec::BleCharacteristic::Commands:
  case spec::BleCharacteristic::PacketsV2:
  case spec::BleCharacteristic::Answers: break;
  }
  return std::nullopt;
}

} // namespace orb::protocol
