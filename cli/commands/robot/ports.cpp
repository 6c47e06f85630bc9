#include "cli/commands/robot/ports.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "cli/commands/commands.h"
#include "cli/commands/robot/serial_ports.h"
#include "cli/context/json.h"
#include "cli/context/save_ball.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress_bar.h"
#include "spec/ble.h"
#include "uploader/bluez.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::cli {
std::vector<Port> find_ports(const Config& config) {
  std::vector<Port> ports;
  for (const auto& [name, ball] : config.balls)
    ports.push_back({"@" + name, ball.url});
  const auto devices = find_devices();
  ports.insert(ports.end(), devices.begin(), devices.end());
  return ports;
}

namespace {

struct PortsOptions {
  std::string format = "text";
  std::string scan = "5s";
  std::vector<std::string> saved;
};

/// Describes a flashable robot by name, if the name is unique. Adds the user's own name for it, if
/// there is one.
Json device_json(const Config& config, const uploader::SeenDevice& device,
                 const std::vector<uploader::SeenDevice>& all) {
  const auto* robot = spec::find_ble_name(device.name);
  const auto same = std::ranges::count(all, device.name, &uploader::SeenDevice::name);
  const auto by_name = robot != nullptr && same == 1;
  auto what = robot != nullptr ? std::string(robot->robot) : std::string("not a robot");
  if (device.rssi)
    what += fmt::format(", {} dBm", *device.rssi);
  what += by_name ? ", " + device.address : device.name.empty() ? "" : ", " + device.name;
  for (const auto& [name, ball] : config.balls)
    if (equal_words(ball.url, "ble://" + device.name) ||
        equal_words(ball.url, "ble://" + device.address))
      what += ", @" + name;
  if (device.connected)
    what += ", connected to this computer";
  if (robot != nullptr && robot->protocol == spec::BleProtocol::V2)
    what += ": stores no programs; `orb run PROGRAM --port` drives it from here";
  if (robot != nullptr && robot->protocol == spec::BleProtocol::None)
    what += ": orb knows it but cannot drive it";
  Json json{{"url", "ble://" + (by_name ? device.name : device.address)}, {"what", what}};
  if (device.rssi)
    json["rssi"] = *device.rssi;
  return json;
}

/// Scans for robots over Bluetooth LE; nothing if scanning is impossible, which prints a note.
/// Fails only if interrupted.
tl::expected<std::optional<std::vector<uploader::SeenDevice>>, Failure> scan(const Context& context,
                                                                             Duration time) {
  using namespace std::chrono;
  if (time == Duration{})
    return std::nullopt;
  const InterruptGuard guard;
  CountBar bar(context, "seconds of listening for Bluetooth LE");
  const auto start = steady_clock::now();
  auto devices = uploader::scan_ble(time, {}, InterruptGuard::asked, [&](std::size_t) {
    bar.show(
        static_cast<std::uint64_t>(duration_cast<seconds>(steady_clock::now() - start).count()),
        static_cast<std::uint64_t>(ceil<seconds>(time).count()));
  });
  if (devices)
    return *std::move(devices);
  if (devices.error().failure == uploader::BleFailure::Interrupted)
    return tl::unexpected(Failure{ExitCode::Interrupted, "interrupted"});
  print_note(context, fmt::format("no Bluetooth LE scan: {}; {}", devices.error().seen,
                                  remedy(devices.error())));
  return std::nullopt;
}

/// Adds robots first. Other devices are counted, and listed with -v.
void add_robots(const Context& context, const std::vector<uploader::SeenDevice>& devices,
                const std::string& listened, Json& ports) {
  std::size_t others = 0;
  for (const auto& device : devices)
    if (spec::find_ble_name(device.name) != nullptr)
      ports.push_back(device_json(context.config, device, devices));
    else
      ++others;
  if (others == devices.size())
    print_note(context,
               fmt::format("no robot was heard within {}; take it off the charger, shake "
                           "it awake, bring it closer, and close any app that may be using it",
                           listened));
  if (others == 0)
    return;
  if (context.verbosity == 0)
    return print_note(context, fmt::format("{} not named like a robot; -v lists them",
                                           plural(others, "other device")));
  for (const auto& device : devices)
    if (spec::find_ble_name(device.name) == nullptr)
      ports.push_back(device_json(context.config, device, devices));
}

void list_ports(Context& context, const PortsOptions& options) {
  // the option has been checked
  const auto devices = scan(context, *parse_duration(options.scan, 1s));
  if (!devices)
    return fail(context, devices.error());
  auto ports = Json::array();
  for (const auto& port : find_ports(context.config))
    ports.push_back({{"url", port.url}, {"what", port.what}});
  if (*devices)
    add_robots(context, **devices, options.scan, ports);
  const bool none = ports.empty();
  ports.push_back({{"url", "sim:"}, {"what", "a virtual ball in this process"}});
  if (options.format == "json")
    return print_json({{"schema", "orb.ports/1"}, {"ports", ports}});
  for (const auto& port : ports)
    print_out(fmt::format("{:<16} {}\n", port["url"].get<std::string>(),
                          port["what"].get<std::string>()));
  if (none)
    print_note(context, fmt::format("no serial port was found; {}", no_device_help));
}

/// Gives a port a name in the user's configuration.
void save_port(Context& context, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == assignment.npos || equals + 1 == assignment.size())
    return fail(context, {ExitCode::Usage, fmt::format("`{}` names no port; write `--save "
                                                       "red=ble://SK-1A2B`",
                                                       assignment)});
  const auto name = assignment.substr(0, equals);
  const auto url = assignment.substr(equals + 1);
  if (const auto endpoint = uploader::parse_endpoint(url); !endpoint)
    return fail(context, {ExitCode::Usage, endpoint.error()});
  const auto file = save_ball(name, url);
  if (!file)
    return fail(context, file.error());
  print_note(context, fmt::format("@{} is {} from now on; saved in {}", name, url, *file));
}

} // namespace

void add_ports(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("ports", "list the ports where a ball could be, and name them",
                      "orb ports\norb ports --scan 20s\norb ports --format json\n"
                      "orb ports --save red=ble://SK-1A2B");
  auto options = std::make_shared<PortsOptions>();
  add_format_option(command, options->format);
  command
      .add_option("--scan", options->scan,
                  "how long to listen for robots over Bluetooth LE; 0 for not at all")
      .type_name("TIME")
      .check([](const std::string& text) {
        return parse_duration(text, 1s) ? std::string()
                                        : "`" + text + "` is not a time such as 5s or 500ms";
      })
      .show_default();
  command
      .add_option("--save", options->saved,
                  "from now on @NAME is this port; several can be saved at once")
      .type_name("NAME=URL");
  command.callback([&context, options] {
    for (const auto& assignment : options->saved)
      if (context.exit == ExitCode::Done)
        save_port(context, assignment);
    if (options->saved.empty())
      list_ports(context, *options);
  });
}

} // namespace orb::cli
