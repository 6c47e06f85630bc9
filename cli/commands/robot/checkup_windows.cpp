#include "cli/commands/robot/checkup.h"

#include "cli/commands/robot/serial_ports.h"

#include <algorithm>

namespace orb::cli {

void check_bluetooth(Checkup& checkup) {
  const auto devices = find_devices();
  const bool paired = std::any_of(devices.begin(), devices.end(), [](const Port& device) {
    return device.what.starts_with("Bluetooth serial port of");
  });
  if (paired)
    checkup.good("a paired Bluetooth device has a COM port");
  else
    checkup.bad(
        "no Bluetooth device has a COM port",
        "shake the ball awake and pair it in the Windows Bluetooth settings; for robots over "
        "Bluetooth LE use the playground in Edge or Chrome");
}

bool check_node(Checkup& checkup, const uploader::Endpoint& endpoint) {
  constexpr std::string_view device = R"(\\.\)";
  auto name = endpoint.path;
  if (name.starts_with(device))
    name.erase(0, device.size());
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const auto devices = find_devices();
  const bool is_there =
      std::any_of(devices.begin(), devices.end(), [&](const Port& one) { return one.url == name; });
  if (is_there)
    checkup.good(fmt::format("{} is a port of this computer", name));
  else
    checkup.bad(fmt::format("{} is not a port of this computer", endpoint.path),
                "`orb ports` lists what there is; find the port of a paired ball in the Bluetooth "
                "settings under \"More Bluetooth options\", \"COM Ports\"");
  return is_there;
}

} // namespace orb::cli
