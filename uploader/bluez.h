#pragma once

#include "uploader/gatt.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// Bluetooth on Linux, over D-Bus. Source: the documents in doc/ of BlueZ 5.66.
namespace orb::uploader {

/// Returns why this build has no Bluetooth LE; nullopt if it has.
std::optional<BleError> no_ble();

/// Returns the robot named by `endpoint`, as BlueZ shows it. Makes no request yet. The destructor
/// disconnects the robot.
std::unique_ptr<Gatt> make_bluez_gatt(const Endpoint& endpoint);

/// A device that advertises over Bluetooth LE.
struct SeenDevice {
  std::string address;
  std::string name;        ///< empty if it advertises none
  std::optional<int> rssi; ///< signal strength in dBm
  bool connected = false;  ///< to this computer
};

/// Returns the devices that advertise within `time`, strongest first. Calls `progress` several
/// times a second with the number seen so far.
tl::expected<std::vector<SeenDevice>, BleError>
scan_ble(Duration time, const Budgets& budgets, const StopRequests& stop,
         const std::function<void(std::size_t)>& progress);

} // namespace orb::uploader
