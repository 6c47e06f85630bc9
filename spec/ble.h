#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// Robots over Bluetooth LE: their characteristics and the greeting that enables commands.
namespace orb::spec {

/// The most bytes per write; the robot supports no larger MTU. Source: LIB
inline constexpr std::size_t ble_piece_bytes = 20;

enum class BleService : std::uint8_t {
#define BLE_SERVICE(enumerator, protocol, uuid, source, summary) enumerator,
#include "spec/ble.def"
};

enum class BleProtocol : std::uint8_t {
  V1,
  V2,
  None ///< neither: recognized by name only, not driven
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

constexpr const BleServiceInfo& info(BleService service) {
  return ble_services[static_cast<std::size_t>(service)];
}
constexpr BleProtocol protocol_of(BleService service) {
  return info(service).protocol;
}
constexpr std::string_view uuid_of(BleService service) {
  return info(service).uuid;
}

enum class BleCharacteristic : std::uint8_t {
#define BLE_CHARACTERISTIC(enumerator, ...) enumerator,
#include "spec/ble.def"
};

struct BleCharacteristicInfo {
  BleCharacteristic characteristic;
  BleService service;
  std::string_view uuid;
  std::string_view summary;
};

inline constexpr auto ble_characteristics = std::to_array<BleCharacteristicInfo>({
#define BLE_CHARACTERISTIC(enumerator, service, uuid, can, value, source, summary)                 \
  {BleCharacteristic::enumerator, BleService::service, uuid, summary},
#include "spec/ble.def"
});

constexpr const BleCharacteristicInfo& info(BleCharacteristic characteristic) {
  return ble_characteristics[static_cast<std::size_t>(characteristic)];
}

constexpr BleProtocol protocol_of(BleCharacteristic characteristic) {
  return protocol_of(info(characteristic).service);
}
/// The characteristics for packets to and from a robot.
constexpr BleCharacteristic takes_packets(BleProtocol protocol) {
  return protocol == BleProtocol::V1 ? BleCharacteristic::Commands : BleCharacteristic::PacketsV2;
}
constexpr BleCharacteristic sends_packets(BleProtocol protocol) {
  return protocol == BleProtocol::V1 ? BleCharacteristic::Answers : BleCharacteristic::PacketsV2;
}

/// The properties of a characteristic, with GATT's values.
namespace ble_can {
inline constexpr std::uint8_t Read = 0x02;
inline constexpr std::uint8_t WriteSilently = 0x04; ///< without an acknowledgement
inline constexpr std::uint8_t Write = 0x08;
inline constexpr std::uint8_t Notify = 0x10;
inline constexpr std::uint8_t Indicate = 0x20;
} // namespace ble_can

/// A characteristic, as service discovery shows it.
struct BleAttributeInfo {
  std::optional<BleCharacteristic> characteristic; ///< nullopt: not used by orb
  BleProtocol protocol;
  std::string_view service;
  std::string_view uuid;
  std::uint8_t can;
  std::string_view value;
  std::string_view summary;
};

/// All of them, in the order of their handles.
inline constexpr auto ble_attributes = [] {
  using namespace ble_can;
  return std::to_array<BleAttributeInfo>({
#define BLE_CHARACTERISTIC(enumerator, service, uuid, can, value, source, summary)                 \
  {BleCharacteristic::enumerator,                                                                  \
   protocol_of(BleService::service),                                                               \
   uuid_of(BleService::service),                                                                   \
   uuid,                                                                                           \
   can,                                                                                            \
   {value, sizeof(value) - 1},                                                                     \
   summary},
#define BLE_ALSO(protocol, service, uuid, can, value, source, summary)                             \
  {{}, BleProtocol::protocol, service, uuid, can, {value, sizeof(value) - 1}, summary},
#include "spec/ble.def"
  });
}();

struct BleAdvertisedInfo {
  BleProtocol protocol;
  std::optional<BleService> service;
  std::optional<int> power_dbm;
  std::optional<int> maker;
};

/// What a robot advertises besides its name.
inline constexpr auto ble_advertised = [] {
  constexpr auto nothing = std::nullopt;
  return std::to_array<BleAdvertisedInfo>({
#define BLE_ADVERTISES(protocol, service, power, maker, source)                                    \
  {BleProtocol::protocol, service, power, maker},
#include "spec/ble.def"
  });
}();

constexpr const BleAdvertisedInfo& advertised(BleProtocol protocol) {
  return *std::find_if(ble_advertised.begin(), ble_advertised.end(),
                       [&](const auto& row) { return row.protocol == protocol; });
}

struct BleGreetingInfo {
  BleCharacteristic characteristic;
  std::string_view bytes;
  std::string_view summary;
};

/// The writes before the first command, in this order.
inline constexpr auto ble_greeting = std::to_array<BleGreetingInfo>({
#define BLE_GREETING(characteristic, bytes, source, summary)                                       \
  {BleCharacteristic::characteristic, bytes, summary},
#include "spec/ble.def"
});

/// True if these bytes can only be a greeting. A single byte may be anything.
constexpr bool is_greeting(std::string_view bytes) {
  return bytes.size() > 1 && std::any_of(ble_greeting.begin(), ble_greeting.end(),
                                         [&](const auto& row) { return row.bytes == bytes; });
}

#define BLE_NUMBER(name, value, source, summary) inline constexpr int name = value; ///< summary
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

/// True if the robot accepts commands without a greeting.
constexpr bool is_open(BleModel which) {
#define BLE_OPEN(model, source)                                                                    \
  if (which == BleModel::model)                                                                    \
    return true;
#include "spec/ble.def"
  return false;
}

/// True if the robot answers nothing until it is greeted.
constexpr bool is_deaf(BleModel which) {
  return info(which).protocol == BleProtocol::V1;
}
/// The time after which the robot ends a link without a greeting; nullopt: never.
constexpr std::optional<std::chrono::seconds> patience(BleModel which) {
#define BLE_DROPS(model, after_s, source)                                                          \
  if (which == BleModel::model)                                                                    \
    return std::chrono::seconds{after_s};
#include "spec/ble.def"
  return std::nullopt;
}

/// True if robots of this model have the characteristic.
constexpr bool has(BleModel model, BleCharacteristic characteristic) {
  return protocol_of(characteristic) == info(model).protocol &&
         (characteristic != BleCharacteristic::AntiDosV2 || !is_open(model));
}

constexpr bool has(BleModel model, const BleAttributeInfo& attribute) {
  return attribute.protocol == info(model).protocol &&
         (!attribute.characteristic || has(model, *attribute.characteristic));
}

/// Finds the robot that advertises `name`; null if the name is unknown.
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
