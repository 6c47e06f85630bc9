#pragma once

#include "serve/fake_bluez.h"
#include "uploader/bluez.h"

namespace orb::cli {

/// The parts of the program that need D-Bus, exported by the module `bluez.so`. D-Bus pulls in nine
/// libraries, a quarter of the run time of a short command, and few commands need it. So the module
/// is loaded only when Bluetooth LE is used.
struct BluezModule {
  const char* build; ///< identifies the interface between program and module; must match
  decltype(&uploader::make_bluez_gatt) make_gatt;
  decltype(&uploader::scan_ble) scan;
  decltype(&serve::make_fake_bluez) make_fake;
};

} // namespace orb::cli

extern "C" {
/// The symbol to look up in the module.
extern const orb::cli::BluezModule orb_bluez_module;
}
