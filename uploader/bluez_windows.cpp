// Bluetooth LE is not supported here: the playground provides it in a browser.

#include "uploader/bluez.h"
#include "uploader/no_gatt.h"

namespace orb::uploader {
namespace {

const BleError elsewhere{BleFailure::NoSystem, "orb for Windows does not support Bluetooth LE"};

} // namespace

std::optional<BleError> no_ble() {
  return elsewhere;
}

std::unique_ptr<Gatt> make_bluez_gatt(const Endpoint&) {
  return std::make_unique<NoGatt>(elsewhere);
}

tl::expected<std::vector<SeenDevice>, BleError>
scan_ble(Duration, const Budgets&, const StopRequests&, const std::function<void(std::size_t)>&) {
  return tl::unexpected(elsewhere);
}

} // namespace orb::uploader
