#include "cli/commands/commands.h"
#include "cli/commands/robot/ports.h"
#include "cli/context/config.h"
#include "cli/context/json.h"
#include "cli/robot/link.h"
#include "cli/robot/newer_robot.h"
#include "cli/terminal/interrupt.h"
#include "run/tether/run_tethered.h"
#include "uploader/bluez.h"
#include "uploader/endpoint.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;
using uploader::Endpoint;
using uploader::Scheme;

constexpr int rfcomm_protocol = 3; // BTPROTO_RFCOMM
constexpr std::string_view rfkill_folder = "/sys/class/rfkill";
constexpr std::string_view adapters_folder = "/sys/class/bluetooth";

/// Prints one finding a line, or gathers them for one JSON document, and knows whether one was bad.
class Checkup {
public:
  Checkup(const Context& context, Json* json) : style_(context.out_style()), json_(json) {}

  void good(std::string_view text) {
    if (json_ != nullptr)
      json_->push_back({{"ok", true}, {"text", text}});
    else
      print_out(fmt::format("{}    {}\n", style_.paint(Role::Good, "ok"), text));
  }
  /// What is wrong, and the command or act that helps.
  void bad(std::string_view text, std::string_view remedy) {
    healthy_ = false;
    if (json_ != nullptr)
      json_->push_back({{"ok", false}, {"text", text}, {"remedy", remedy}});
    else
      print_out(fmt::format("{} {}\n      {}\n", style_.paint(Role::Error, "wrong"), text, remedy));
  }
  bool healthy() const { return healthy_; }

private:
  Style style_;
  Json* json_; ///< null where the findings are printed as they come
  bool healthy_ = true;
};

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// Whether a radio switch holds Bluetooth back.
void check_rfkill(Checkup& checkup) {
  std::error_code error;
  for (fs::directory_iterator entry(rfkill_folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (first_line(entry->path() / "type") != "bluetooth")
      continue;
    if (first_line(entry->path() / "hard") == "1")
      checkup.bad("Bluetooth is switched off in hardware", "turn the radio switch on");
    else if (first_line(entry->path() / "soft") == "1")
      checkup.bad("Bluetooth is blocked", "`rfkill unblock bluetooth`");
    else
      checkup.good("no radio switch blocks Bluetooth");
  }
}

void check_bluetooth(Checkup& checkup) {
  const auto handle = ::socket(AF_BLUETOOTH, SOCK_STREAM, rfcomm_protocol);
  if (handle < 0) {
    checkup.bad(fmt::format("this system has no Bluetooth sockets: {}", std::strerror(errno)),
                "`sudo modprobe rfcomm`; in a container use tcp:// and a relay on the host: `socat "
                "FILE:/dev/rfcomm0,raw TCP-LISTEN:4242`");
    return;
  }
  ::close(handle);
  checkup.good("Bluetooth sockets are available");
  std::error_code error;
  if (fs::is_empty(adapters_folder, error) || error)
    checkup.bad("no Bluetooth adapter found", "plug one in; `bluetoothctl list` shows them");
  check_rfkill(checkup);
}

/// What robots over Bluetooth LE need of the computer; none is looked for.
void check_ble(Checkup& checkup) {
  const auto gatt = uploader::make_bluez_gatt({});
  for (const auto step : {protocol::BleStep::Bus, protocol::BleStep::Adapter}) {
    const auto found = gatt->go(step, {gatt->now() + uploader::Budgets{}.ble_answer, {}});
    if (!found)
      return checkup.bad(fmt::format("Bluetooth LE: {}", found.error().seen),
                         remedy(found.error()));
    checkup.good(fmt::format("Bluetooth LE: {}", *found));
  }
}

/// Whether the node is there, is a device and may be opened; it is not opened here.
bool check_node(Checkup& checkup, const Endpoint& endpoint) {
  struct stat status {};
  if (::stat(endpoint.path.c_str(), &status) != 0) {
    checkup.bad(fmt::format("{}: {}", endpoint.path, std::strerror(errno)),
                endpoint.scheme == Scheme::Pty
                    ? "start a virtual ball: `orb ball --pty`"
                    : "`orb ports` lists what there is; `sudo rfcomm bind 0 AA:BB:CC:DD:EE:FF 1` "
                      "makes one for a paired ball");
    return false;
  }
  if (!S_ISCHR(status.st_mode)) {
    checkup.bad(fmt::format("{} is {}, not a device", endpoint.path,
                            S_ISDIR(status.st_mode) ? "a directory" : "a file"),
                "give the path of a device; `orb ports` lists them");
    return false;
  }
  checkup.good(fmt::format("{} is a device", endpoint.path));
  if (::access(endpoint.path.c_str(), R_OK | W_OK) != 0) {
    checkup.bad(fmt::format("no permission to read and write {}", endpoint.path),
                "`sudo usermod -aG dialout $USER`, then log in again");
    return false;
  }
  checkup.good("you may read and write it");
  return true;
}

/// What this computer needs for any robot, and what could be one.
void check_computer(const Context& context, Checkup& checkup) {
  for (const auto& port : find_ports(context.config))
    checkup.good(fmt::format("{} may be a ball ({}); `orb doctor --port {}` looks closer", port.url,
                             port.what, port.url));
  check_bluetooth(checkup);
  check_ble(checkup);
}

/// What a robot of packets v2 says of itself.
tl::expected<void, Failure> check_newer(Checkup& checkup, Link& link,
                                        const spec::RobotInfo& robot) {
  run::TalkV2 talk(*link.transport, robot);
  if (const auto pinged = talk.request(spec::V2Command::Ping); !pinged)
    return tl::unexpected(pinged.error());
  checkup.good(fmt::format("a {} answers", robot.title));
  const auto answer = talk.ask(spec::V2Command::GetVoltageState);
  if (!answer)
    return tl::unexpected(answer.error());
  enum { Ok = 1, Low, Critical };
  const int state = answer->error != 0 || answer->data.empty() ? 0 : answer->data.front();
  if (state == Low || state == Critical)
    checkup.bad(fmt::format("its battery is {}", state == Low ? "low" : "critical"),
                "put it on the charger");
  else if (state == Ok)
    checkup.good("its battery is OK");
  checkup.good(fmt::format("it keeps no programs: `orb run PROGRAM --port {}` drives it from here",
                           link.name));
  return {};
}

/// Whether a robot of packets v2 answers; then it has been looked at.
bool is_newer(Checkup& checkup, Link& link) {
  constexpr Duration patience = 3s;
  const auto found = run::find_robot(*link.transport, patience);
  if (found && spec::info(*found).packets == spec::Packets::V2) {
    if (const auto done = check_newer(checkup, link, spec::info(*found)); !done)
      checkup.bad("the robot stopped answering", done.error().message);
    return true;
  }
  if (!found && found.error().code == ExitCode::Usage) { // it answers, and several are like it
    checkup.bad("a newer robot answers and does not say which it is", found.error().message);
    return true;
  }
  return false;
}

/// Opens the link and greets the ball.
void check_ball(Context& context, Checkup& checkup, const PortOptions& given,
                const std::string& robot) {
  const InterruptGuard guard;
  auto told = false; // why it does not open
  const auto* newer = newer_robot(context, given, robot);
  auto options = given;
  options.accepts = uploader::Accepts::All;
  if (newer != nullptr)
    options.robot = newer->robot;
  auto link = open_link(context, options, [&](protocol::BleStep, const auto& found) {
    told = !found;
    if (found)
      checkup.good(*found);
    else if (found.error().failure != uploader::BleFailure::Interrupted)
      checkup.bad(found.error().seen, remedy(found.error()));
  });
  if (!link) {
    if (link.error().code == ExitCode::Interrupted)
      return fail(context, link.error());
    if (!told)
      checkup.bad("the link cannot be opened", link.error().message);
    return;
  }
  if (!link->is_sim)
    checkup.good(fmt::format("{} opens", link->name));
  if (newer != nullptr) {
    if (const auto done = check_newer(checkup, *link, *newer); !done)
      checkup.bad("no robot answers", done.error().message);
    return;
  }
  if (!link->is_sim && is_newer(checkup, *link))
    return;
  uploader::Session session(*link->transport, link->budgets, link->first_seq);
  const auto greeting = uploader::greet(session);
  if (!greeting) {
    const auto code = exit_code(greeting.error().kind);
    if (code == ExitCode::Interrupted)
      return fail(context, {code, greeting.error().message});
    checkup.bad("no ball answers", greeting.error().message);
    return;
  }
  checkup.good(link->is_sim ? "the built-in virtual ball answers" : "a ball answers");
  if (const auto noise = session.counts().noise_in; noise > 0)
    checkup.good(fmt::format("{} stray bytes came first, as real balls send them", noise));
  if (greeting->firmware.in_bootloader)
    checkup.bad("it is in its bootloader, where nothing runs",
                uploader::bootloader_remedy(link->name));
  const auto state = greeting->power_state();
  if (state == spec::power_state::low || state == spec::power_state::critical)
    checkup.bad(fmt::format("its battery is {}", spec::value_name("power state", state)),
                "put it on the charger");
  else if (state != 0)
    checkup.good(fmt::format("its battery is {}", spec::value_name("power state", state)));
}

enum class Asked { ThePort, TheComputer };

void run(Context& context, const PortOptions& options, const std::string& format,
         const std::string& robot, Asked asked) {
  auto list = Json::array();
  auto* const gathered = format == "json" ? &list : nullptr;
  Checkup checkup(context, gathered);
  if (asked == Asked::TheComputer)
    check_computer(context, checkup);
  const auto url = resolve_port(context.config, options.port);
  const auto endpoint =
      url ? uploader::parse_endpoint(*url)
          : tl::expected<Endpoint, std::string>(tl::unexpected(url.error().message));
  if (!endpoint)
    return fail(context, {ExitCode::Usage, endpoint.error()});
  auto reachable = true;
  switch (endpoint->scheme) {
  case Scheme::Serial:
  case Scheme::Pty: reachable = check_node(checkup, *endpoint); break;
  case Scheme::Rfcomm: check_bluetooth(checkup); break;
  case Scheme::Ble:
  case Scheme::Tcp:
  case Scheme::Replay:
  case Scheme::Sim: break;
  }
  if (reachable)
    check_ball(context, checkup, options, robot);
  if (asked == Asked::TheComputer)
    print_note(context,
               "no robot was tried: `orb doctor --port URL` tries one, `orb ports` lists them");
  if (gathered != nullptr)
    print_json({{"schema", "orb.doctor/1"}, {"healthy", checkup.healthy()}, {"findings", list}});
  if (!checkup.healthy())
    context.exit = ExitCode::NoBall;
}

} // namespace

void add_doctor(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("doctor", "find out why a connection fails, and how to fix it",
                      "orb doctor\n"
                      "orb doctor --port /dev/rfcomm0\n"
                      "orb doctor --port rfcomm://68:86:E7:00:11:22\n"
                      "orb doctor --port ble://SK-1A2B");
  auto options = std::make_shared<PortOptions>();
  add_port_options(command, *options);
  auto robot = std::make_shared<std::string>();
  add_newer_robot_option(command, *robot);
  auto format = std::make_shared<std::string>("text");
  add_format_option(command, *format);
  command.callback([&context, options, format, robot, command] {
    const auto asked = command.find("--port")->given() ? Asked::ThePort : Asked::TheComputer;
    run(context, *options, *format, *robot, asked);
  });
}

} // namespace orb::cli
