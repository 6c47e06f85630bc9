#include "cli/commands/robot/devices.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <windows.h>

namespace orb::cli {
namespace {

struct Driver {
  std::wstring_view device; ///< how the names of its devices begin
  std::string_view what;
};

constexpr Driver drivers[] = {
    {LR"(\Device\BthModem)", "Bluetooth serial port of a paired device"},
    {LR"(\Device\VCP)", "USB serial adapter"},
    {LR"(\Device\USBSER)", "USB modem or microcontroller"},
};

std::string_view what_is(std::wstring_view device) {
  for (const auto& driver : drivers)
    if (device.starts_with(driver.device))
      return driver.what;
  return "serial port";
}

/// The number of a port: `COM12` comes after `COM5`.
int number_of(const Port& port) {
  return std::atoi(port.url.c_str() + std::string_view("COM").size());
}

} // namespace

/// Windows keeps the names of all ports, with the device behind each.
std::vector<Port> find_devices() {
  std::vector<Port> devices;
  HKEY key = nullptr;
  if (::RegOpenKeyExW(HKEY_LOCAL_MACHINE, LR"(HARDWARE\DEVICEMAP\SERIALCOMM)", 0, KEY_READ, &key) !=
      ERROR_SUCCESS)
    return devices;
  std::array<wchar_t, MAX_PATH> device{};
  std::array<wchar_t, MAX_PATH> port{};
  for (DWORD i = 0;; ++i) {
    DWORD device_size = device.size();
    DWORD port_size = sizeof port - sizeof(wchar_t);
    DWORD type = 0;
    port.fill(L'\0');
    if (::RegEnumValueW(key, i, device.data(), &device_size, nullptr, &type,
                        reinterpret_cast<BYTE*>(port.data()), &port_size) != ERROR_SUCCESS)
      break;
    if (type == REG_SZ)
      devices.push_back({std::filesystem::path(port.data()).string(),
                         std::string(what_is({device.data(), device_size}))});
  }
  ::RegCloseKey(key);
  std::sort(devices.begin(), devices.end(),
            [](const Port& a, const Port& b) { return number_of(a) < number_of(b); });
  return devices;
}

} // namespace orb::cli
