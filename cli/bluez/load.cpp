// Bluetooth LE for the program `orb`: the functions of uploader/bluez.h and serve/fake_bluez.h,
// loaded from a module.

#include "cli/bluez/module.h"
#include "uploader/no_gatt.h"

#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>

namespace orb {
namespace {

using cli::BluezModule;

/// Loads the module from its path relative to the program. `$ORIGIN` would not work: with a
/// sanitizer it is the sanitizer's folder.
tl::expected<const BluezModule*, std::string> load() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) // never fall back to the current folder: anybody may have put a module there
    return tl::unexpected("/proc/self/exe: " + error.message());
  const auto path = (program.parent_path() / ORB_BLUEZ_MODULE).lexically_normal().string();
  // stays loaded until the program ends
  auto* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    return tl::unexpected(std::string(dlerror()));
  const auto* found = static_cast<const BluezModule*>(dlsym(library, "orb_bluez_module"));
  if (found == nullptr || std::string_view(found->build) != ORB_BLUEZ_BUILD)
    return tl::unexpected(path + " belongs to another build of orb");
  return found;
}

const tl::expected<const BluezModule*, std::string>& bluez_module() {
  static const auto loaded = load();
  return loaded;
}

uploader::BleError not_loaded() {
  return {uploader::BleFailure::NotLoaded,
          "the module for Bluetooth LE cannot be loaded: " + bluez_module().error()};
}

} // namespace

namespace uploader {

std::optional<BleError> no_ble() {
  if (bluez_module())
    return std::nullopt;
  return not_loaded();
}

std::unique_ptr<Gatt> make_bluez_gatt(const Endpoint& endpoint) {
  if (!bluez_module())
    return std::make_unique<NoGatt>(not_loaded());
  return (*bluez_module())->make_gatt(endpoint);
}

tl::expected<std::vector<SeenDevice>, BleError>
scan_ble(Duration time, const Budgets& budgets, const StopRequests& stop,
         const std::function<void(std::size_t)>& progress) {
  if (!bluez_module())
    return tl::unexpected(not_loaded());
  return (*bluez_module())->scan(time, budgets, stop, progress);
}

} // namespace uploader

namespace serve {

tl::expected<std::unique_ptr<FakeBluez>, IoError>
make_fake_bluez(asio::io_context& io, const protocol::BleFaultPlan& plan) {
  if (!bluez_module()) {
    const auto error = not_loaded();
    return tl::unexpected(IoError{fmt::format("{}; {}", error.seen, remedy(error))});
  }
  return (*bluez_module())->make_fake(io, plan);
}

} // namespace serve
} // namespace orb
