#include "cli/commands/robot/serial_ports.h"

#include <algorithm>
#include <filesystem>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

struct Pattern {
  std::string_view prefix; ///< of device names below /dev
  std::string_view what;
};

constexpr std::string_view device_folder = "/dev";
constexpr Pattern patterns[] = {
    {"rfcomm", "Bluetooth serial port (rfcomm bind)"},
    {"cu.Sphero", "Bluetooth serial port of a paired Sphero"},
    {"cu.BB-8", "Bluetooth serial port of a paired BB-8"},
    {"ttyUSB", "USB serial adapter"},
    {"ttyACM", "USB modem or microcontroller"},
};

} // namespace

const std::string_view no_device_help =
    "for a paired Sphero, create one with `sudo rfcomm bind 0 AA:BB:CC:DD:EE:FF 1`, or use its "
    "address: rfcomm://AA:BB:CC:DD:EE:FF";

std::vector<Port> find_devices() {
  std::vector<Port> devices;
  std::error_code error;
  for (fs::directory_iterator entry(device_folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto name = entry->path().filename().string();
    for (const auto& pattern : patterns)
      if (name.starts_with(pattern.prefix) && entry->is_character_file(error))
        devices.push_back({entry->path().string(), std::string(pattern.what)});
  }
  std::sort(devices.begin(), devices.end(),
            [](const Port& a, const Port& b) { return a.url < b.url; });
  return devices;
}

} // namespace orb::cli
