#include "cli/monitoring.h"

#include "cli/commands.h"

#include <memory>

namespace orb::cli {
namespace {

struct Options {
  PortOptions port;
  std::string map;
};

void run(Context& context, const Options& options) {
  LineMap lines;
  if (!options.map.empty()) {
    auto map = read_line_map(options.map);
    if (!map) {
      print_error(context, map.error());
      context.exit = ExitCode::File;
      return;
    }
    lines = *std::move(map);
  }
  with_ball(context, options.port,
            [&](Link& link, uploader::Session& session, const uploader::Greeting&) {
              print_note(context, "listening; Ctrl-C ends");
              return monitor(context, link, session, lines).lost ? ExitCode::LinkLost
                                                                 : ExitCode::Done;
            });
}

} // namespace

void add_monitor(CLI::App& app, Context& context) {
  auto* command =
      add_command(app, "monitor", "print what a ball says: prints, errors, markers, collisions",
                  "orb monitor --port /dev/rfcomm0\n"
                  "orb monitor --port @red --map square.json");
  auto options = std::make_shared<Options>();
  add_port_options(*command, options->port);
  command
      ->add_option("--map", options->map,
                   "a map of `orb build --map`: errors then point into the source")
      ->type_name("FILE");
  command->callback([&context, options] { run(context, *options); });
}

} // namespace orb::cli
