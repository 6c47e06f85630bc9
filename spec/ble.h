#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// Robots over Bluetooth LE: which characteristics there are and what opens a robot to commands.
namespace orb::spec {

/// The most bytes that a robot takes at once; it has no larger MTU. Source: LIB
inline constexpr std::size_t ble_piece_bytes = 20;

enum class BleService : std::uint8_t {
#define BLE_SERVICE(enumerator, protocol, uuid, source, summary) enumerator,
#include "spec/ble.def"
};

enum class BleProtocol : std::uint8_t {
  V1,
  V2,
  None ///< neither: the robot is known by its name, and not driven
};

struct BleServiceInfo {
  BleService service;
  BleProtocol protocol;
  std::string_view uuid;
};

inline constexpr auto ble_services = std::to_array<BleServiceInfo>({
#define BLE_SERVICE(enumerator, protocol, uuid, source, summary)                                   \
  {BleService::enumerator, BleProtocol::protocol, uuid},
#include "spec/ble.def"
});

enum class BleCharacteristic : std::uint8_t {
#define BLE_CHARACTERISTIC(enumerator, service, uuid, source, summary) enumerator,
#include "spec/ble.def"
};

struct BleCharacteristicInfo {
  BleCharacteristic characteristic;
  BleService service;
  std::string_view uuid;
  std::string_view summary;
};

inline constexpr auto ble_characteristics = std::to_array<BleCharacteristicInfo>({
#define BLE_CHARACTERISTIC(enumerator, service, uuid, source, summary)                             \
  {BleCharacteristic::enumerator, BleService::service, uuid, summary},
#include "spec/ble.def"
});

constexpr const BleCharacteristicInfo& info(BleCharacteristic characteristic) {
  return ble_characteristics[static_cast<std::size_t>(characteristic)];
}

constexpr BleProtocol protocol_of(BleCharacteristic characteristic) {
  return ble_services[static_cast<std::size_t>(info(characteristic).service)].protocol;
}
/// Where a robot takes packets, and where it notifies of packets.
constexpr BleCharacteristic takes_packets(BleProtocol protocol) {
  return protocol == BleProtocol::V1 ? BleCharacteristic::Commands : BleCharacteristic::PacketsV2;
}
constexpr BleCharacteristic sends_packets(BleProtocol protocol) {
  return protocol == BleProtocol::V1 ? BleCharacteristic::Answers : BleCharacteristic::PacketsV2;
}

struct BleGreetingInfo {
  BleCharacteristic characteristic;
  std::string_view bytes;
  std::string_view summary;
};

/// What is written before the first command, in this order.
inline constexpr auto ble_greeting = std::to_array<BleGreetingInfo>({
#define BLE_GREETING(characteristic, bytes, source, summary)                                       \
  {BleCharacteristic::characteristic, bytes, summary},
#include "spec/ble.def"
});

/// How many robots an adapter is connected to at once.
#define BLE_LINKS(name, links, source, summary) inline constexpr int name = links; ///< summary
#include "spec/ble.def"

enum class BleModel : std::uint8_t {
#define BLE_NAME(enumerator, prefix, protocol, robot, source) enumerator,
#include "spec/ble.def"
};

struct BleNameInfo {
  BleModel model;
  std::string_view prefix;
  BleProtocol protocol;
  std::string_view robot;
};

inline constexpr auto ble_names = std::to_array<BleNameInfo>({
#define BLE_NAME(enumerator, prefix, protocol, robot, source)                                      \
  {BleModel::enumerator, prefix, BleProtocol::protocol, robot},
#include "spec/ble.def"
});

constexpr const BleNameInfo& info(BleModel model) {
  return ble_names[static_cast<std::size_t>(model)];
}

/// Whether the robot takes commands without a greeting.
constexpr bool is_open(BleModel which) {
#define BLE_OPEN(model, source)                                                                    \
  if (which == BleModel::model)                                                                    \
    return true;
#include "spec/ble.def"
  return false;
}

/// The row of the robot that advertises `name`; null for a name that no robot is known to have.
constexpr const BleNameInfo* find_ble_name(std::string_view name) {
  for (const auto& row : ble_names)
    if (name.starts_with(row.prefix))
      return &row;
  return nullptr;
}

consteval bool ble_rows_are_right() {
  for (std::size_t i = 0; i < ble_characteristics.size(); ++i)
    for (std::size_t j = i + 1; j < ble_characteristics.size(); ++j)
      if (ble_characteristics[i].uuid == ble_characteristics[j].uuid)
        return false;
  for (const auto& row : ble_greeting)
    if (row.bytes.empty() || row.bytes.size() > ble_piece_bytes)
      return false;
  return true;
}
static_assert(ble_rows_are_right());

} // namespace orb::spec
