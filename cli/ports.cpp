#include "cli/ports.h"

#include "cli/commands.h"
#include "cli/json.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

struct Pattern {
  std::string_view prefix; ///< of the name below /dev
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

std::vector<Port> find_ports(const Config& config) {
  std::vector<Port> ports;
  for (const auto& [name, url] : config.balls)
    ports.push_back({"@" + name, url});
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
  ports.insert(ports.end(), devices.begin(), devices.end());
  return ports;
}

void add_ports(CLI::App& app, Context& context) {
  auto* command = add_command(app, "ports", "list where a ball could be",
                              "orb ports\norb ports --quiet\norb ports --format json");
  auto format = std::make_shared<std::string>("text");
  add_format_option(*command, *format);
  command->callback([&context, format] {
    auto ports = find_ports(context.config);
    const bool none = ports.empty();
    ports.push_back({"sim:", "a ball in this process"});
    if (*format == "json") {
      Json json{{"schema", "orb.ports/1"}, {"ports", Json::array()}};
      for (const auto& port : ports)
        json["ports"].push_back({{"url", port.url}, {"what", port.what}});
      return print_json(json);
    }
    for (const auto& port : ports)
      print_out(fmt::format("{:<16} {}\n", port.url, port.what));
    if (none)
      print_note(context,
                 "no serial port was found; for a paired Sphero make one with `sudo rfcomm "
                 "bind 0 AA:BB:CC:DD:EE:FF 1`, or use its address: "
                 "rfcomm://AA:BB:CC:DD:EE:FF");
  });
}

} // namespace orb::cli
