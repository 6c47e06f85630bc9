#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/json.h"
#include "cli/messages.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct Options {
  PortOptions port;
  std::string map;
  std::string format = "text";
};

tl::expected<run::LineMap, Failure> read_map(const std::string& path) {
  const auto text = read_text(path);
  if (!text)
    return tl::unexpected(text.error());
  auto map = run::parse_line_map(*text);
  if (!map)
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("{} is not a map that `orb build --map` wrote", path)});
  return *std::move(map);
}

/// The program that a map is of; nothing where it is not there any more, or where the map says the
/// place of a line better than the source, which has no numbers.
std::vector<run::Input> read_program(const run::LineMap& map) {
  if (map.files.empty() || map.known == run::Known::FileAndColumn)
    return {};
  auto inputs = read_inputs({map.files.front()}, "basic", {}, run::Findings::None);
  return inputs && inputs->front().program ? *std::move(inputs) : std::vector<run::Input>();
}

void listen(Context& context, const Options& options) {
  Lookup lookup;
  std::vector<run::Input> inputs;
  if (!options.map.empty()) {
    auto map = read_map(options.map);
    if (!map)
      return fail(context, map.error());
    lookup.lines = *std::move(map);
    inputs = read_program(lookup.lines);
    lookup.input = inputs.empty() ? nullptr : &inputs.front();
  }
  with_ball(context, options.port,
            [&](Link& link, uploader::Session& session, const uploader::Greeting&) {
              print_note(context, "listening; Ctrl-C ends");
              return monitor(context, link, session, lookup, options.format).lost
                         ? ExitCode::LinkLost
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
  add_format_option(*command, options->format);
  command
      ->add_option("--map", options->map,
                   "a map of `orb build --map`: errors then point into the source")
      ->type_name("FILE");
  command->callback([&context, options] { listen(context, *options); });
}

} // namespace orb::cli
