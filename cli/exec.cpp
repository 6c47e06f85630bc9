#include "base/suggest.h"
#include "cli/commands.h"
#include "cli/messages.h"
#include "protocol/describe.h"
#include "protocol/payload.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct Options {
  PortOptions port;
  std::string name;
  std::vector<std::string> arguments;
  bool monitor = false;
};

const spec::CommandInfo* find(const Context& context, const std::string& name) {
  if (const auto* row = spec::find_command(name))
    return row;
  std::vector<std::string_view> names;
  for (const auto& row : spec::api_commands)
    names.push_back(row.name);
  const auto meant = closest(name, names);
  print_error(context, fmt::format("`{}` is not a command of the API{}", name,
                                   meant ? fmt::format("; did you mean `{}`?", *meant)
                                         : "; `orb spec commands` lists them"));
  return nullptr;
}

/// The answer in words, with its fields by name.
std::string describe(spec::ApiCommand command, const protocol::Response& response) {
  protocol::Describer describer;
  const auto item_of = [](protocol::Direction direction, const Bytes& packet) {
    protocol::Decoder decoder(direction);
    decoder.feed(packet);
    return *decoder.next();
  };
  const auto asked = encode(protocol::make_command(command, {}, response.seq));
  (void)describer.describe(item_of(protocol::Direction::ToBall, asked));
  const auto answered = encode(response);
  return describer.describe(item_of(protocol::Direction::FromBall, answered));
}

void run(Context& context, const Options& options) {
  const auto* row = find(context, options.name);
  if (row == nullptr) {
    context.exit = ExitCode::Usage;
    return;
  }
  const auto data = protocol::encode_operands(row->command, options.arguments);
  if (!data)
    return fail(context, {ExitCode::Usage, data.error().message});
  with_ball(context, options.port,
            [&](Link& link, uploader::Session& session, const uploader::Greeting&) {
              const auto answer = request(session, row->command, *data);
              if (!answer) {
                print_error(context, answer.error().message);
                return exit_code(answer.error().kind);
              }
              print_out(describe(row->command, *answer) + "\n");
              if (options.monitor && monitor(context, link, session, {}).lost)
                return ExitCode::LinkLost;
              return ExitCode::Done;
            });
}

} // namespace

void add_exec(CLI::App& app, Context& context) {
  auto* command = add_command(app, "exec", "send one command of the API and print the answer",
                              "orb exec --port /dev/rfcomm0 set-rgb-led 255 0 0\n"
                              "orb exec --port @red get-power-state\n"
                              "orb exec ping");
  auto options = std::make_shared<Options>();
  command->add_option("NAME", options->name, "the command, as `orb spec commands` lists it")
      ->required();
  command->add_option("ARGS", options->arguments, "its operands");
  add_port_options(*command, options->port);
  command->add_flag("--monitor", options->monitor, "then print what the ball says, until Ctrl-C");
  command->callback([&context, options] { run(context, *options); });
}

} // namespace orb::cli
