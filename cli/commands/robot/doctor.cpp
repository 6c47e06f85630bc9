#include "cli/commands/commands.h"
#include "cli/commands/robot/checkup.h"
#include "cli/commands/robot/ports.h"
#include "cli/context/config.h"
#include "cli/context/json.h"
#include "cli/robot/reach.h"
#include "cli/terminal/interrupt.h"
#include "protocol/packet.h"
#include "protocol/payload.h"
#include "run/tether/hail.h"
#include "uploader/bluez.h"
#include "uploader/endpoint.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

using uploader::Endpoint;
using uploader::Scheme;

/// Checks what robots over Bluetooth LE need of the computer; does not scan.
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

/// Checks what this computer needs for any robot, and lists devices that may be one.
void check_computer(const Context& context, Checkup& checkup) {
  for (const auto& port : find_ports(context.config))
    checkup.good(fmt::format("{} may be a ball ({}); `orb doctor --port {}` checks it", port.url,
                             port.what, port.url));
  check_bluetooth(checkup);
  check_ble(checkup);
}

/// Reports what a packets v2 robot says about itself.
tl::expected<void, Failure> look_at(Checkup& checkup, Link& link, const Newer& newer) {
  run::TalkV2 talk(*link.transport, newer.robot);
  if (const auto pinged = talk.request(spec::V2Command::Ping); !pinged)
    return tl::unexpected(pinged.error());
  checkup.good(fmt::format("{} answers", with_article(newer.title)));
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
  checkup.good(fmt::format("it stores no programs: `orb run PROGRAM --port {}` drives it from here",
                           link.name));
  return {};
}

/// Reports that sent bytes came back: the wires are good.
void tell_echo(Checkup& checkup) {
  checkup.bad(
      "the port echoes: TX and RX are connected together, and the UART itself works",
      "take the bridge off and connect the RVR: TX of the computer to RX of the robot, RX to "
      "TX, ground to ground");
}

/// Lists remedies of RVR owners for a silent UART. Source: LIB
void tell_of_uart(Checkup& checkup) {
  checkup.bad("on a serial port an RVR may not listen yet",
              "update it once with the vendor's app: with its first firmware the UART was off");
  checkup.bad("or its wires are not where they should be",
              "connect TX to RX, RX to TX and ground to ground");
  checkup.bad("or the computer keeps the port for itself",
              "on a Raspberry Pi use `/dev/serial0`, write `enable_uart=1` in config.txt and take "
              "`console=serial0,115200` out of cmdline.txt, then restart");
  checkup.bad("or the port itself does not work",
              "join TX and RX with a wire and run this command again: a port that works echoes");
}

/// Explains why nothing answers: what was received, and remedies if that was nothing.
void tell_silence(Checkup& checkup, Link& link, std::string_view what, std::string_view why) {
  constexpr Duration patience = 600ms;
  run::Hail hail(*link.transport);
  auto heard = hail.write(protocol::encode(protocol::make_command(spec::ApiCommand::Ping, {})));
  for (const auto until = hail.now() + patience; heard && hail.now() < until && !hail.echoes();)
    if (const auto read = hail.read(until); !read)
      heard = tl::unexpected(read.error());
  if (hail.echoes())
    return tell_echo(checkup);
  checkup.bad(what, why);
  if (link.is_uart && heard)
    tell_of_uart(checkup);
}

/// Identifies a packets v2 robot and checks it.
void check_newer(Checkup& checkup, Link& link, std::optional<spec::Robot> told,
                 std::string_view given) {
  const auto newer = find_newer(link, told);
  if (!newer)
    return checkup.bad("a newer robot answers but does not say which model it is",
                       newer.error().message);
  if (const auto done = look_at(checkup, link, *newer); !done)
    tell_silence(checkup, link, "no robot answers", name_robot(link, given, done.error()).message);
}

/// Opens the link and greets the ball.
void check_ball(Context& context, Checkup& checkup, const PortOptions& given,
                const std::string& robot) {
  const InterruptGuard guard;
  auto explained = false; // why it cannot be opened
  auto options = given;
  if (const auto* row = spec::find_robot(robot))
    options.robot = row->robot;
  auto link = open_link(context, options, [&](protocol::BleStep, const auto& found) {
    explained = !found;
    if (found)
      checkup.good(*found);
    else if (found.error().failure != uploader::BleFailure::Interrupted)
      checkup.bad(found.error().seen, remedy(found.error()));
  });
  if (!link) {
    if (link.error().code == ExitCode::Interrupted)
      return fail(context, link.error());
    if (!explained)
      checkup.bad("the link cannot be opened", link.error().message);
    return;
  }
  if (!link->is_sim)
    checkup.good(fmt::format("{} can be opened", link->name));
  const auto told = told_robot(*link, robot);
  if (link->packets == spec::Packets::V2 ||
      (told && spec::info(*told).packets == spec::Packets::V2))
    return check_newer(checkup, *link, told, robot);
  run::Hail hail(*link->transport);
  uploader::Session session(link->packets ? *link->transport : hail, link->budgets,
                            link->first_seq);
  const auto greeting = uploader::greet(session);
  if (hail.answered() == spec::Packets::V2)
    return check_newer(checkup, *link, std::nullopt, robot);
  if (!greeting) {
    const auto code = exit_code(greeting.error().kind);
    if (code == ExitCode::Interrupted)
      return fail(context, {code, greeting.error().message});
    return tell_silence(checkup, *link, "no ball answers", greeting.error().message);
  }
  checkup.good(link->is_sim ? "the built-in virtual ball answers" : "a ball answers");
  if (const auto noise = session.counts().noise_in; noise > 0)
    checkup.good(fmt::format("{} stray bytes came first, as is normal with real balls", noise));
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

void examine(Context& context, const PortOptions& options, const std::string& format,
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
  add_robot_option(command, *robot);
  auto format = std::make_shared<std::string>("text");
  add_format_option(command, *format);
  command.callback([&context, options, format, robot, command] {
    const auto asked = command.find("--port")->given() ? Asked::ThePort : Asked::TheComputer;
    examine(context, *options, *format, *robot, asked);
  });
}

} // namespace orb::cli
