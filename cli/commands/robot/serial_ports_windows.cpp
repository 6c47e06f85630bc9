#include "cli/commands/robot/serial_ports.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <windows.h>

#include <setupapi.h> // needs windows.h

namespace orb::cli {
namespace {

using Text = std::array<wchar_t, MAX_PATH>;

/// "Ports (COM & LPT)" in the device manager.
constexpr GUID ports_class = {0x4D36E978, 0xE325, 0x11CE, {0xBF, 0xC1, 8, 0, 0x2B, 0xE1, 3, 0x18}};

struct Driver {
  std::wstring_view device; ///< how names of its devices begin
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

/// The number of a port, for sorting: `COM12` comes after `COM5`.
int number_of(const Port& port) {
  return std::atoi(port.url.c_str() + std::string_view("COM").size());
}

std::string in_utf8(const wchar_t* text) {
  return std::filesystem::path(text).string();
}

/// What the device manager shows about a device.
struct Device {
  std::string id; ///< such as `BTHENUM\DEV_6886E7001122\7&1A2B3C4D&0&BLUETOOTHDEVICE_6886E7001122`
  std::string name; ///< its own or its driver's, such as `USB Serial Port (COM3)`
  std::string port; ///< COM5; empty if it is not a port
};

std::string port_of(HDEVINFO all, SP_DEVINFO_DATA& one) {
  const auto key = ::SetupDiOpenDevRegKey(all, &one, DICS_FLAG_GLOBAL, 0, DIREG_DEV, KEY_READ);
  if (key == INVALID_HANDLE_VALUE)
    return {};
  Text port{};
  DWORD size = sizeof port;
  const auto read =
      ::RegGetValueW(key, nullptr, L"PortName", RRF_RT_REG_SZ, nullptr, port.data(), &size);
  ::RegCloseKey(key);
  return read == ERROR_SUCCESS ? in_utf8(port.data()) : std::string();
}

/// The devices of a class, or those of an enumerator such as Bluetooth.
std::vector<Device> devices_of(const GUID* kind, const wchar_t* enumerator) {
  std::vector<Device> devices;
  const auto all = ::SetupDiGetClassDevsW(kind, enumerator, nullptr,
                                          DIGCF_PRESENT | (kind == nullptr ? DIGCF_ALLCLASSES : 0));
  if (all == INVALID_HANDLE_VALUE)
    return devices;
  SP_DEVINFO_DATA one{};
  one.cbSize = sizeof one;
  for (DWORD i = 0; ::SetupDiEnumDeviceInfo(all, i, &one) != 0; ++i) {
    Text id{};
    Text name{};
    ::SetupDiGetDeviceInstanceIdW(all, &one, id.data(), id.size(), nullptr);
    ::SetupDiGetDeviceRegistryPropertyW(all, &one, SPDRP_FRIENDLYNAME, nullptr,
                                        reinterpret_cast<BYTE*>(name.data()),
                                        sizeof name - sizeof(wchar_t), nullptr);
    devices.push_back({in_utf8(id.data()), in_utf8(name.data()), port_of(all, one)});
  }
  ::SetupDiDestroyDeviceInfoList(all);
  return devices;
}

/// A Bluetooth port has the address of its peer in its id, before the last `_`:
/// `BTHENUM\{00001101-...}_LOCALMFG&0002\7&1A2B3C4D&0&6886E7001122_C00000000`. The address is all
/// zeros for a port that accepts incoming connections.
std::string describe_bluetooth(const Device& port) {
  const auto end = port.id.rfind('_');
  const auto begin = port.id.rfind('&', end) + 1;
  const auto address = port.id.substr(begin, end - begin);
  if (address.find_first_not_of('0') == std::string::npos)
    return "Bluetooth serial port for incoming connections";
  for (const auto& device : devices_of(nullptr, L"BTHENUM"))
    if (device.id.starts_with("BTHENUM\\DEV_" + address) && !device.name.empty())
      return fmt::format("Bluetooth serial port of {}", device.name);
  return "Bluetooth serial port of a paired device";
}

/// The name that Windows shows, without the port in parentheses at its end.
std::string describe_port(const Device& port) {
  return port.id.starts_with("BTHENUM\\") ? describe_bluetooth(port)
                                          : port.name.substr(0, port.name.rfind(" (COM"));
}

} // namespace

const std::string_view no_device_help =
    "shake the ball awake and pair it in the Windows Bluetooth settings, which gives it a port";

/// Windows lists all ports with the driver's device name. Many of them also appear in the device
/// manager.
std::vector<Port> find_devices() {
  std::vector<Port> devices;
  HKEY key = nullptr;
  if (::RegOpenKeyExW(HKEY_LOCAL_MACHINE, LR"(HARDWARE\DEVICEMAP\SERIALCOMM)", 0, KEY_READ, &key) !=
      ERROR_SUCCESS)
    return devices;
  const auto known = devices_of(&ports_class, nullptr);
  Text device{};
  Text port{};
  for (DWORD i = 0;; ++i) {
    DWORD device_size = device.size();
    DWORD port_size = sizeof port - sizeof(wchar_t);
    DWORD type = 0;
    port.fill(L'\0');
    if (::RegEnumValueW(key, i, device.data(), &device_size, nullptr, &type,
                        reinterpret_cast<BYTE*>(port.data()), &port_size) != ERROR_SUCCESS)
      break;
    if (type != REG_SZ)
      continue;
    const auto name = in_utf8(port.data());
    const auto found = std::ranges::find(known, name, &Device::port);
    const auto what = found != known.end() ? describe_port(*found) : std::string();
    devices.push_back(
        {name, what.empty() ? std::string(what_is({device.data(), device_size})) : what});
  }
  ::RegCloseKey(key);
  std::sort(devices.begin(), devices.end(),
            [](const Port& a, const Port& b) { return number_of(a) < number_of(b); });
  return devices;
}

} // namespace orb::cli
