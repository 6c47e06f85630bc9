#pragma once

#include "spec/ble.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::protocol {

/// The way to a robot over Bluetooth LE, in its order.
enum class BleStep : std::uint8_t {
  Bus,      ///< the Bluetooth service of the computer answers
  Adapter,  ///< its radio is on
  Find,     ///< the robot is seen
  Connect,  ///< it is connected
  Services, ///< its characteristics are known
  AntiDos,  ///< the three words of spec/ble.def, from here
  TxPower,
  Wake,     ///< … to here
  Subscribe ///< its packets come as notifications
};

struct BleStepInfo {
  BleStep step;
  std::string_view word;  ///< in plans of faults
  std::string_view doing; ///< for messages: "the link was lost while …"
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

/// The step in which a characteristic is written to; none for the others.
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
