#include "base/text/utf8.h"
#include "cli/commands/commands.h"
#include "cli/context/json.h"
#include "cli/many/many.h"
#include "cli/robot/reach.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"
#include "spec/firmware.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace orb::cli {
namespace {

using spec::ApiCommand;

/// One table row per robot, used for several robots.
constexpr std::string_view row_format = "row";

/// The fields of an answer by name, as text.
class Fields {
public:
  Fields(ApiCommand command, ByteView data)
      : values_(protocol::read_fields(spec::answer(command), data)) {}

  std::optional<std::int64_t> number(std::string_view name) const {
    for (const auto& value : values_)
      if (value.field->name == name)
        return value.number;
    return std::nullopt;
  }
  /// A version in two nibbles: `1.6`.
  std::string nibbles(std::string_view name) const {
    const auto value = number(name).value_or(0);
    return fmt::format("{}.{}", value >> 4, value & 15);
  }
  std::string text(std::string_view name) const {
    for (const auto& value : values_)
      if (value.field->name == name) {
        const auto bytes = as_text(value.bytes);
        return to_printable(bytes.substr(0, bytes.find('\0')));
      }
    return {};
  }

private:
  std::vector<protocol::FieldValue> values_;
};

std::string versions_text(const std::string& port, const uploader::Greeting& greeting) {
  const Fields fields(ApiCommand::GetVersioning, greeting.versions);
  auto text = fmt::format("model     {:02X}h, hardware {}\n", fields.number("model").value_or(0),
                          fields.number("hardware").value_or(0));
  if (greeting.firmware.in_bootloader)
    return text + fmt::format("firmware  not running: the ball is in its bootloader, {}\n"
                              "help      {}\n",
                              fields.nibbles("bootloader"), uploader::bootloader_remedy(port));
  text +=
      fmt::format("firmware  {}.{}, bootloader {}\n", fields.number("firmware version").value_or(0),
                  fields.number("firmware revision").value_or(0), fields.nibbles("bootloader"));
  const auto& firmware = greeting.firmware;
  text += firmware.has_basic
              ? fmt::format("orbBasic  {}, {} bytes of RAM, {} of flash{}\n",
                            fields.nibbles("orbBasic"), firmware.ram_bytes, firmware.flash_bytes,
                            firmware.can_commit ? "" : ", no commit to flash")
              : std::string("orbBasic  none: only macros run on this ball\n");
  text += fmt::format("macros    executive {}\n", fields.nibbles("macro executive"));
  if (const auto major = fields.number("api major"))
    text += fmt::format("API       {}.{}\n", *major, fields.number("api minor").value_or(0));
  return text;
}

std::string power_text(ByteView power) {
  const Fields fields(ApiCommand::GetPowerState, power);
  const auto state = static_cast<std::uint32_t>(fields.number("power state").value_or(0));
  return fmt::format("battery   {}, {:.2f} V, {} charges, {} s awake since the last\n",
                     spec::value_name("power state", state),
                     static_cast<double>(fields.number("voltage").value_or(0)) / 100,
                     fields.number("charges").value_or(0),
                     fields.number("since charge").value_or(0));
}

Json versions_json(const std::string& port, const uploader::Greeting& greeting) {
  const Fields fields(ApiCommand::GetVersioning, greeting.versions);
  const auto& firmware = greeting.firmware;
  Json json{{"model", fields.number("model").value_or(0)},
            {"hardware", fields.number("hardware").value_or(0)},
            {"firmware", fmt::format("{}.{}", fields.number("firmware version").value_or(0),
                                     fields.number("firmware revision").value_or(0))},
            {"bootloader", fields.nibbles("bootloader")}};
  if (firmware.in_bootloader) {
    json.erase("firmware");
    json["inBootloader"] = true;
    json["help"] = uploader::bootloader_remedy(port);
    return json;
  }
  if (firmware.has_basic)
    json["orbBasic"] = {{"version", fields.nibbles("orbBasic")},
                        {"ramBytes", firmware.ram_bytes},
                        {"flashBytes", firmware.flash_bytes},
                        {"commit", firmware.can_commit}};
  json["macroExecutive"] = fields.nibbles("macro executive");
  if (const auto major = fields.number("api major"))
    json["api"] = fmt::format("{}.{}", *major, fields.number("api minor").value_or(0));
  return json;
}

Json power_json(ByteView power) {
  const Fields fields(ApiCommand::GetPowerState, power);
  const auto state = static_cast<std::uint32_t>(fields.number("power state").value_or(0));
  return {{"state", spec::value_name("power state", state)},
          {"volts", static_cast<double>(fields.number("voltage").value_or(0)) / 100},
          {"charges", fields.number("charges").value_or(0)},
          {"secondsSinceCharge", fields.number("since charge").value_or(0)}};
}

/// The information of the text form as one JSON document.
Json info_json(const std::string& port, const uploader::Greeting& greeting) {
  Json json{{"schema", "orb.info/1"}, {"port", port}};
  json.update(versions_json(port, greeting));
  if (greeting.power)
    json["battery"] = power_json(*greeting.power);
  return json;
}

/// Asks if a robot accepts a command, with a request that changes nothing. Nothing if it does not
/// answer.
std::optional<bool> takes(uploader::Session& session, ApiCommand command, const Bytes& data) {
  const auto answer = request(session, command, data);
  if (!answer && answer.error().kind != uploader::Report::Kind::Refused)
    return std::nullopt;
  if (answer)
    return true;
  const auto code = static_cast<spec::ResponseCode>(answer.error().code);
  return code != spec::ResponseCode::BadCommand && code != spec::ResponseCode::BadDevice &&
         code != spec::ResponseCode::Unsupported;
}

std::string_view yes_or_no(std::optional<bool> answer) {
  return !answer ? "unknown" : *answer ? "yes" : "no";
}

/// Queries what the firmware of a robot over Bluetooth LE can do: no document tells.
void ask_for_programs(uploader::Session& session, std::string& text, Json& json) {
  const auto nothing = Bytes{static_cast<std::uint8_t>(spec::Area::Ram)}; // appends nothing
  const auto basic = takes(session, ApiCommand::AppendOrbbasicFragment, nothing);
  const auto macros = takes(session, ApiCommand::GetMacroStatus, {});
  text += fmt::format("takes     orbBasic programs: {}, macros: {}\n", yes_or_no(basic),
                      yes_or_no(macros));
  if (basic)
    json["takes"]["orbBasic"] = *basic;
  if (macros)
    json["takes"]["macros"] = *macros;
}

/// The answer of a packets v2 robot as text; empty if it refuses.
tl::expected<std::string, Failure> told(run::TalkV2& talk, spec::V2Command command) {
  const auto answer = talk.ask(command);
  if (!answer)
    return tl::unexpected(answer.error());
  const ByteView data = answer->data;
  constexpr std::size_t version = 6;
  if (answer->error != 0 || data.empty())
    return std::string();
  if (data.size() == version &&
      (command == spec::V2Command::GetMainVersion || command == spec::V2Command::GetBootVersion))
    return fmt::format("{}.{}.{}", read_u16(data, 0), read_u16(data, 2), read_u16(data, 4));
  if (command == spec::V2Command::GetVoltage && data.size() == 2)
    return fmt::format("{:.2f} V", read_u16(data, 0) / 100.0);
  if (command == spec::V2Command::GetPercent)
    return fmt::format("{} %", data[0]);
  if (command == spec::V2Command::GetVoltageState)
    return std::string(data[0] == 1   ? "ok"
                       : data[0] == 2 ? "low"
                       : data[0] == 3 ? "critical"
                                      : "unknown");
  if (command == spec::V2Command::GetBoardRevision)
    return std::to_string(data[0]);
  const auto text = as_text(data);
  return to_printable(text.substr(0, text.find('\0')));
}

/// The table row of one robot.
std::string info_summary(const Json& json) {
  std::vector<std::string> parts;
  const auto add = [&](const Json& holder, const char* key, const char* format) {
    if (holder.contains(key))
      parts.push_back(fmt::format(fmt::runtime(format), holder[key].get<std::string>()));
  };
  add(json, json.contains("robot") ? "robot" : "name", "{}");
  add(json, "firmware", "firmware {}");
  const auto battery = json.value("battery", Json());
  if (battery.is_object()) {
    add(battery, "state", "battery {}");
    parts.push_back(fmt::format("{:.2f} V", battery.value("volts", 0.0)));
  } else {
    add(json, "battery", "battery {}");
    add(json, "charge", "{}");
  }
  if (json.value("inBootloader", false))
    parts.emplace_back("in its bootloader");
  return fmt::format("{}\n", fmt::join(parts, ", "));
}

void print_info(std::string_view format, const Json& json, const std::string& text) {
  if (format == "json")
    print_json(json);
  else
    print_out(format == row_format ? info_summary(json) : text);
}

/// Prints what a packets v2 robot says about itself, one line or JSON key per answer.
tl::expected<void, Failure> tell_all_v2(const PortOptions& options, const std::string& format,
                                        run::TalkV2& talk, const Newer& newer) {
  struct Line {
    std::string_view word;
    spec::V2Command command;
  };
  constexpr Line lines[] = {{"firmware", spec::V2Command::GetMainVersion},
                            {"bootloader", spec::V2Command::GetBootVersion},
                            {"board", spec::V2Command::GetBoardRevision},
                            {"model", spec::V2Command::GetModel},
                            {"address", spec::V2Command::GetMac},
                            {"battery", spec::V2Command::GetVoltage},
                            {"charge", spec::V2Command::GetPercent},
                            {"power", spec::V2Command::GetVoltageState}};
  const auto& robot = newer.robot;
  Json json{{"schema", "orb.info/1"}, {"port", options.port}, {"robot", robot.name}};
  auto text = fmt::format("{:<11}{}\n{:<11}{}\n", "port", options.port, "robot", newer.title);
  for (const auto& line : lines) {
    if (!spec::knows(robot, spec::info(line.command)))
      continue;
    const auto said = told(talk, line.command);
    if (!said)
      return tl::unexpected(said.error());
    if (said->empty())
      continue;
    text += fmt::format("{:<11}{}\n", line.word, *said);
    json[std::string(line.word)] = *said;
  }
  text += fmt::format("{:<11}keeps none; `orb run PROGRAM --port {}` drives it from here\n",
                      "programs", options.port);
  json["programs"] = false;
  print_info(format, json, text);
  return {};
}

ExitCode tell_all_v1(const Context& context, const std::string& format, Link& link,
                     uploader::Session& session, const uploader::Greeting& greeting) {
  auto json = info_json(link.name, greeting);
  auto text = fmt::format("port      {}\n", link.name) + versions_text(link.name, greeting);
  if (greeting.power)
    text += power_text(*greeting.power);
  if (const auto radio = request(session, ApiCommand::GetBluetoothInfo)) {
    const Fields fields(ApiCommand::GetBluetoothInfo, radio->data);
    text +=
        fmt::format("name      {}\naddress   {}\n", fields.text("name"), fields.text("address"));
    json["name"] = fields.text("name");
    json["address"] = fields.text("address");
  } else if (radio.error().kind != uploader::Report::Kind::Refused) {
    print_error(context, radio.error().message);
    return exit_code(radio.error().kind);
  }
  if (link.is_ble && !greeting.firmware.in_bootloader)
    ask_for_programs(session, text, json);
  print_info(format, json, text);
  return ExitCode::Done;
}

void tell_all(Context& context, const PortOptions& options, const std::string& format,
              const std::string& robot) {
  const auto classic = [&](Link& link, uploader::Session& session,
                           const uploader::Greeting& greeting) {
    return tell_all_v1(context, format, link, session, greeting);
  };
  const auto newer = [&](Link&, run::TalkV2& talk, const Newer& found) {
    return tell_all_v2(options, format, talk, found);
  };
  with_robot(context, options, robot, {classic, newer});
}

} // namespace

void add_info(const Command& orb, Context& context) {
  const auto command = orb.add_command("info", "show a ball's model, versions, battery and name",
                                       "orb info --port /dev/rfcomm0\n"
                                       "orb info --port rfcomm://68:86:E7:00:11:22\n"
                                       "orb info --port ble://SK-1A2B\n"
                                       "orb info --port ble://SB-1A2B\n"
                                       "orb info --ports class.toml");
  struct Options {
    RosterOptions roster;
    PortOptions port;
    std::string robot;
    std::string format = "text";
  };
  auto options = std::make_shared<Options>();
  add_roster_options(command, options->roster, links_at_once());
  add_link_options(command, options->port);
  add_robot_option(command, options->robot);
  add_format_option(command, options->format);
  command.callback([&context, options] {
    ManyOptions many;
    many.command = "info";
    many.jobs = spec::ble_links_every;
    many.again = TryAgain::Lost;
    many.prints = Prints::Answer;
    many.json = options->format == "json";
    with_robots(context, options->roster, many,
                [&](Context& own, const RosterMember& robot, const Row* row) {
                  const auto in_table = row != nullptr && options->format == "text";
                  tell_all(own, port_of(options->port, robot, row),
                           in_table ? std::string(row_format) : options->format, options->robot);
                });
  });
}

} // namespace orb::cli
