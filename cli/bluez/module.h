#pragma once

#include "serve/fake_bluez.h"
#include "uploader/bluez.h"

namespace orb::cli {

/// The parts of the program that need D-Bus, as the module `bluez.so` gives them. D-Bus brings nine
/// libraries, which take a quarter of the time of a short command and which few commands need, so
/// the module is loaded when Bluetooth LE is asked for.
struct BluezModule {
  const char* build; ///< names what the program and the module give each other; must be the same
  decltype(&uploader::make_bluez_gatt) make_gatt;
  decltype(&uploader::scan_ble) scan;
  decltype(&serve::make_fake_bluez) make_fake;
};

} // namespace orb::cli

extern "C" {
/// The name that is looked up in the module.
extern const orb::cli::BluezModule orb_bluez_module;
}
