#include "base/text/suggest.h"
#include "cli/commands/commands.h"
#include "cli/commands/robot/monitor.h"
#include "cli/context/json.h"
#include "cli/many/many.h"
#include "cli/robot/reach.h"
#include "cli/terminal/interrupt.h"
#include "protocol/describe.h"
#include "protocol/describe_v2.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::cli {
namespace {

struct ExecOptions {
  RosterOptions roster;
  PortOptions port;
  std::string name;
  std::vector<std::string> arguments;
  std::string format = "text";
  std::string robot;
  bool monitor = false;
};

Failure unknown_to(const Newer& newer, const std::string& name) {
  std::vector<std::string_view> names;
  for (const auto& one : spec::v2_commands)
    if (spec::knows(newer.robot, one))
      names.push_back(one.name);
  return {ExitCode::Usage, fmt::format("`{}` is not a command of the {}; {}", name, newer.title,
                                       did_you_mean(name, names, "`orb spec robots` lists them"))};
}

/// Sends a packets v2 command and prints the answer. Wakes a sleeping robot first.
tl::expected<void, Failure> execute_v2(Context& context, const ExecOptions& options,
                                       run::TalkV2& talk, const Newer& newer) {
  const auto* row = spec::find_v2_command(options.name);
  if (row == nullptr)
    return tl::unexpected(unknown_to(newer, options.name));
  const auto data = protocol::encode_operands(row->command, options.arguments);
  if (!data)
    return tl::unexpected(Failure{ExitCode::Usage, data.error()});
  const auto power = spec::info(spec::V2Command::Wake).did();
  if (row->did() > power)
    if (const auto awake = talk.request(spec::V2Command::Wake); !awake)
      return tl::unexpected(awake.error());
  const auto answer = talk.ask(row->command, *data);
  if (!answer)
    return tl::unexpected(answer.error());
  const auto bytes = encode(*answer);
  protocol::DecoderV2 decoder;
  decoder.feed(bytes);
  print_out(protocol::DescriberV2{}.describe(*decoder.next()) + "\n");
  if (answer->error != 0)
    context.exit = ExitCode::Refused;
  return {};
}

Failure unknown_command(const std::string& name) {
  std::vector<std::string_view> names;
  for (const auto& row : spec::api_commands)
    names.push_back(row.name);
  return {ExitCode::Usage,
          fmt::format("`{}` is not an API command; {}", name,
                      did_you_mean(name, names, "`orb spec api-commands` lists them"))};
}

/// The same for a link with packets v1.
Failure unknown_to_classic(const std::string& name) {
  if (spec::find_v2_command(name) == nullptr)
    return unknown_command(name);
  return {ExitCode::Usage, fmt::format("`{}` is a command of the newer robots, and this is a "
                                       "classic ball; `orb spec api-commands` lists what it takes",
                                       name)};
}

/// Decodes the answer to `command` into words or values.
template <class Describe>
auto with_answer(spec::ApiCommand command, const protocol::Response& response, Describe describe) {
  protocol::Describer describer;
  const auto asked = protocol::make_command(command, {}, response.seq);
  const auto question = encode(asked);
  (void)describer.parts(item_of(asked, question)); // the answer has the fields of the command
  const auto packet = encode(response);
  return describe(describer, item_of(response, packet));
}

constexpr Duration patience = 60s; // a ball takes time to level itself

/// The message that the answer to a command announces; null for most, and for a command that only
/// stops.
const spec::AsyncInfo* announced(spec::ApiCommand command, const Bytes& data) {
  if (command == spec::ApiCommand::SelfLevel && (data.at(0) & spec::self_level_options::start) == 0)
    return nullptr;
  const auto ids = fmt::format("{:02X}h {:02X}h", spec::did(command), spec::cid(command));
  const auto row = std::find_if(spec::asyncs.begin(), spec::asyncs.end(), [&](const auto& one) {
    return one.arrival == spec::Arrival::AsAnswer && one.enabler == ids;
  });
  return row == spec::asyncs.end() ? nullptr : &*row;
}

/// Waits for a message; nothing if it did not arrive in time or the link broke.
std::optional<protocol::Async> wait_for(uploader::Session& session, spec::AsyncId id) {
  auto& inbox = session.inbox();
  const auto find = [&] {
    return std::find_if(inbox.begin(), inbox.end(), [&](const protocol::Async& one) {
      return one.id == static_cast<std::uint8_t>(id);
    });
  };
  static_cast<void>(
      session.listen(session.now() + patience, [&] { return find() != inbox.end(); }));
  const auto found = find();
  if (found == inbox.end())
    return std::nullopt;
  auto message = *std::move(found);
  inbox.erase(found);
  return message;
}

/// A message on one line, or unchanged if it is plain text.
std::string in_words(const protocol::Async& message) {
  const auto packet = encode(message);
  const auto item = item_of(message, packet);
  protocol::Describer describer;
  const auto parts = describer.parts(item);
  if (parts.fields.size() == 1 && !parts.fields[0].number && parts.rest.empty() &&
      spec::fields(static_cast<spec::AsyncId>(message.id))[0].unit == "text")
    return parts.fields[0].text;
  return describer.describe(item) + "\n";
}

ExitCode print_answer(const Context& context, const ExecOptions& options, spec::ApiCommand command,
                      const Bytes& data, const protocol::Response& answer,
                      uploader::Session& session) {
  const auto* more = announced(command, data);
  const auto message = more == nullptr ? std::nullopt : wait_for(session, more->id);
  if (options.format == "json") {
    Json json{{"schema", "orb.exec/1"}};
    with_answer(command, answer, [&](auto& describer, const protocol::Item& item) {
      json.update(packet_json(describer, item));
    });
    if (message)
      json["message"] = message_json(*message);
    print_json(json);
  } else {
    with_answer(command, answer, [](auto& describer, const protocol::Item& item) {
      print_out(describer.describe(item) + "\n");
    });
    if (message)
      print_out(in_words(*message));
  }
  if (more == nullptr || message)
    return ExitCode::Done;
  if (InterruptGuard::asked() > 0) {
    print_error(context, fmt::format("interrupted; the ball has begun {} and will still send {}",
                                     spec::info(command).name, more->name));
    return ExitCode::Interrupted;
  }
  print_error(context, fmt::format("the answer announces {}, but it never came", more->name));
  return ExitCode::LinkLost;
}

ExitCode execute_v1(Context& context, const ExecOptions& options, Link& link,
                    uploader::Session& session) {
  const auto failed = [&](const Failure& failure) {
    print_error(context, failure.message);
    return failure.code;
  };
  const auto* row = spec::find_command(options.name);
  if (row == nullptr)
    return failed(unknown_to_classic(options.name));
  const auto data = protocol::encode_operands(row->command, options.arguments);
  if (!data)
    return failed({ExitCode::Usage, data.error().message});
  const auto answer = request(session, row->command, *data);
  if (!answer)
    return failed({exit_code(answer.error().kind), answer.error().message});
  const auto told = print_answer(context, options, row->command, *data, *answer, session);
  if (told == ExitCode::Done && options.monitor &&
      monitor(context, link, session, {}, options.format).lost)
    return ExitCode::LinkLost;
  return told;
}

/// Reports mistakes in the words before anything is opened, as far as they do not depend on the
/// robot.
tl::expected<void, Failure> check_words(const Context& context, const ExecOptions& options) {
  const auto* v1 = spec::find_command(options.name);
  const auto* v2 = spec::find_v2_command(options.name);
  const auto* given = spec::find_robot(options.robot);
  auto told = given != nullptr ? std::optional(given->robot)
                               : named_robot(context.config, options.port.port);
  if (!told && options.port.port == "sim:")
    told = options.port.robot;
  if (told && spec::info(*told).packets == spec::Packets::V1)
    v2 = nullptr;
  if (told && spec::info(*told).packets == spec::Packets::V2) {
    v1 = nullptr;
    if (v2 == nullptr)
      return tl::unexpected(unknown_to(newer_of(*told), options.name));
  }
  if (v1 == nullptr && v2 == nullptr && options.port.port == "sim:" &&
      spec::find_v2_command(options.name) != nullptr)
    return tl::unexpected(
        Failure{ExitCode::Usage, fmt::format("`{}` is a command of the newer robots; say which one "
                                             "`sim:` is, as in `--robot mini`",
                                             options.name)});
  if (v1 == nullptr && v2 == nullptr)
    return tl::unexpected(unknown_to_classic(options.name));
  const auto data_v1 = v1 == nullptr ? tl::expected<Bytes, protocol::EncodeError>()
                                     : protocol::encode_operands(v1->command, options.arguments);
  const auto data_v2 = v2 == nullptr ? tl::expected<Bytes, std::string>()
                                     : protocol::encode_operands(v2->command, options.arguments);
  if (v2 == nullptr && !data_v1)
    return tl::unexpected(Failure{ExitCode::Usage, data_v1.error().message});
  if (v1 == nullptr && !data_v2)
    return tl::unexpected(Failure{ExitCode::Usage, data_v2.error()});
  return {};
}

void execute(Context& context, const ExecOptions& options) {
  if (const auto good = check_words(context, options); !good)
    return fail(context, good.error());
  const auto classic = [&](Link& link, uploader::Session& session, const uploader::Greeting&) {
    return execute_v1(context, options, link, session);
  };
  const auto newer = [&](Link&, run::TalkV2& talk, const Newer& robot) {
    return execute_v2(context, options, talk, robot);
  };
  with_robot(context, options.port, options.robot, {classic, newer});
}

/// Why one of several robots cannot take the command.
std::optional<std::string> lacking_command(const ExecOptions& options, const RosterMember& member) {
  if (!member.robot)
    return std::nullopt;
  const auto& robot = spec::info(*member.robot);
  const auto* v2 = spec::find_v2_command(options.name);
  const bool knows = robot.packets == spec::Packets::V1
                         ? spec::find_command(options.name) != nullptr
                         : v2 != nullptr && spec::knows(robot, *v2);
  if (knows)
    return std::nullopt;
  return fmt::format("is a {}, which has no command `{}`; omit it, or send another command "
                     "to it",
                     robot.title, options.name);
}

} // namespace

void add_exec(const Command& orb, Context& context) {
  const auto command = orb.add_command("exec", "send one API command and print the answer",
                                       "orb exec --port /dev/rfcomm0 set-rgb-led 255 0 0\n"
                                       "orb exec --port @red get-power-state\n"
                                       "orb exec perform-level-1-diagnostics\n"
                                       "orb exec get-power-state --format json\n"
                                       "orb exec --port ble://SB-1A2B get-battery-voltage\n"
                                       "orb exec --ports class.toml set-rgb-led 0 0 255");
  auto options = std::make_shared<ExecOptions>();
  command.add_option("NAME", options->name, "the command, as `orb spec api-commands` lists it")
      .required();
  command.add_option("ARGS", options->arguments, "its operands");
  add_roster_options(command, options->roster, links_at_once());
  add_link_options(command, options->port);
  add_robot_option(command, options->robot);
  add_format_option(command, options->format);
  command.add_flag("--monitor", options->monitor, "then print what the ball sends, until Ctrl-C");
  command.callback([&context, options] {
    ManyOptions many;
    many.command = "exec";
    many.jobs = spec::ble_links_every;
    many.prints = Prints::Answer;
    many.json = options->format == "json";
    many.check = [options]() -> tl::expected<void, Failure> {
      if (options->monitor)
        return tl::unexpected(listens_to_one());
      if (!spec::find_command(options->name) && !spec::find_v2_command(options->name))
        return tl::unexpected(unknown_command(options->name));
      return {};
    };
    many.misfit = [options](const RosterMember& robot) { return lacking_command(*options, robot); };
    with_robots(context, options->roster, many,
                [&](Context& own, const RosterMember& robot, const Row* row) {
                  auto one = *options;
                  one.port = port_of(one.port, robot, row);
                  execute(own, one);
                });
  });
}

} // namespace orb::cli
