#include "cli/bluez/module.h"

const orb::cli::BluezModule orb_bluez_module{
    ORB_BLUEZ_BUILD,
    orb::uploader::make_bluez_gatt,
    orb::uploader::scan_ble,
    orb::serve::make_fake_bluez,
};
