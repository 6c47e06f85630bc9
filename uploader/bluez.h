#pragma once

#include "uploader/gatt.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// The Bluetooth of Linux, over D-Bus. Source: the documents in doc/ of BlueZ 5.66.
namespace orb::uploader {

/// Why this program has no Bluetooth LE, if it has none.
std::optional<BleError> no_ble();

/// The robot that `endpoint` names, as BlueZ shows it; nothing is asked for yet. At its end the
/// robot is disconnected.
std::unique_ptr<Gatt> make_bluez_gatt(const Endpoint& endpoint);

/// Something that advertises itself over Bluetooth LE.
struct SeenDevice {
  std::string address;
  std::string name;        ///< empty where it tells none
  std::optional<int> rssi; ///< how strongly it is received, in dBm
  bool connected = false;  ///< to this computer
};

/// What advertises itself within `time`, the strongest first. `progress` hears several times a
/// second how much was seen so far.
tl::expected<std::vector<SeenDevice>, BleError>
scan_ble(Duration time, const Budgets& budgets, const Stop& stop,
         const std::function<void(std::size_t)>& progress);

} // namespace orb::uploader
